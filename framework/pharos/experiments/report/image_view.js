// Two images of one size in one place, divided by a line: the left image is shown left of it, the
// right image right of it. Both are moved and magnified together.

const kLargestZoom = 96;  // CSS pixels per image pixel

class ImageView {
  /** The `stage` holds a canvas and the line. `onChange` is called after each drawing. */
  constructor(stage, canvas, split, onChange) {
    Object.assign(this, { stage, canvas, split, onChange });
    this.sides = [];
    this.fraction = 0.5;  // fraction of the stage's width left of the line
    this.center = { x: 0, y: 0 };  // point of the image in the middle of the stage
    this.zoom = 1;
    this.fitted = true;
    new ResizeObserver(() => this.draw()).observe(stage);
  }

  get width() { return this.stage.clientWidth; }
  get height() { return this.stage.clientHeight; }
  get size() { return { width: this.sides[0].width, height: this.sides[0].height }; }

  /** Shows two canvases. The view stays the same if the size does. */
  show(left, right) {
    const before = this.sides.length ? this.size : null;
    this.sides = [left, right];
    const { width, height } = this.size;
    this.stage.style.aspectRatio = `${width} / ${height}`;
    this.stage.style.maxWidth = `min(100%, max(20rem, 78vh * ${width / height}))`;
    if (!before || before.width !== width || before.height !== height) this.fitted = true;
    this.draw();
  }

  fitZoom() {
    const { width, height } = this.size;
    return Math.min(this.width / width, this.height / height);
  }

  fit() {
    this.fitted = true;
    this.draw();
  }

  /** Magnifies by `factor` about a point of the stage. */
  zoomBy(factor, x = this.width / 2, y = this.height / 2) {
    const fixed = this.imagePoint(x, y);
    const least = this.fitZoom();
    this.zoom = Math.min(Math.max(this.zoom * factor, least), Math.max(kLargestZoom, least));
    this.fitted = this.zoom === least;
    this.center.x = fixed.x - (x - this.width / 2) / this.zoom;
    this.center.y = fixed.y - (y - this.height / 2) / this.zoom;
    this.draw();
  }

  /** Moves the images by CSS pixels. */
  moveBy(dx, dy) {
    if (this.fitted) return;
    this.center.x -= dx / this.zoom;
    this.center.y -= dy / this.zoom;
    this.draw();
  }

  setSplit(fraction) {
    this.fraction = Math.min(1, Math.max(0, fraction));
    this.draw();
  }

  /** Returns the point of the image at a point of the stage. */
  imagePoint(x, y) {
    return {
      x: this.center.x + (x - this.width / 2) / this.zoom,
      y: this.center.y + (y - this.height / 2) / this.zoom,
    };
  }

  /** Limits the position, so that no edge of the image passes the middle of the stage. */
  place() {
    const { width, height } = this.size;
    if (this.fitted) {
      this.zoom = this.fitZoom();
      this.center = { x: width / 2, y: height / 2 };
    }
    this.center.x = Math.min(width, Math.max(0, this.center.x));
    this.center.y = Math.min(height, Math.max(0, this.center.y));
  }

  draw() {
    if (this.sides.length === 0 || this.width === 0) return;
    this.place();
    const density = devicePixelRatio;
    const { canvas } = this;
    canvas.width = Math.round(this.width * density);
    canvas.height = Math.round(this.height * density);
    const context = canvas.getContext("2d");
    const scale = this.zoom * density;
    // Positions are whole pixels of the screen, so that equal pixels of the image look equal.
    const left = Math.round(canvas.width / 2 - this.center.x * scale);
    const top = Math.round(canvas.height / 2 - this.center.y * scale);
    const line = Math.round(this.fraction * canvas.width);
    context.imageSmoothingEnabled = scale < 1;
    context.imageSmoothingQuality = "high";
    this.sides.forEach((side, i) => {
      context.save();
      context.beginPath();
      context.rect(i ? line : 0, 0, i ? canvas.width - line : line, canvas.height);
      context.clip();
      context.drawImage(side, left, top, side.width * scale, side.height * scale);
      context.restore();
    });
    this.split.style.left = `${100 * this.fraction}%`;
    this.split.setAttribute("aria-valuenow", String(Math.round(100 * this.fraction)));
    this.stage.classList.toggle("zoomed", !this.fitted);
    this.onChange();
  }
}
