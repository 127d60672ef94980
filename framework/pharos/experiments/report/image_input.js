// Pointer and key input of an ImageView.

const kWheelStep = 1.0015;  // magnification for each unit of the wheel
const kKeyZoom = 1.25;
const kKeyMove = 40;    // CSS pixels
const kKeySplit = 0.02;  // fraction of the width

/** Drags the line, moves the image, or pinches, depending on the number of pointers and where they start. */
function takePointers(view, onPoint) {
  const { stage, split } = view;
  const pointers = new Map();
  let dragsLine = false;
  const placeOf = (event) => {
    const box = stage.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const spread = ([a, b]) => Math.hypot(a.x - b.x, a.y - b.y);
  const middle = ([a, b]) => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });

  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stage.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, placeOf(event));
    dragsLine = event.target === split && pointers.size === 1;
  });
  stage.addEventListener("pointermove", (event) => {
    const now = placeOf(event);
    onPoint(now);
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const old = [...pointers.values()];
    pointers.set(event.pointerId, now);
    if (pointers.size === 2) {
      const pair = [...pointers.values()];
      const [from, to] = [middle(old), middle(pair)];
      view.zoomBy(spread(pair) / Math.max(1, spread(old)), from.x, from.y);
      view.moveBy(to.x - from.x, to.y - from.y);
    } else if (dragsLine) {
      view.setSplit(now.x / view.width);
    } else {
      view.moveBy(now.x - before.x, now.y - before.y);
    }
  });
  for (const end of ["pointerup", "pointercancel"]) {
    stage.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  stage.addEventListener("dblclick", () => view.fit());
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    const { x, y } = placeOf(event);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 33 : 1;
    view.zoomBy(kWheelStep ** (-event.deltaY * lines), x, y);
    onPoint({ x, y });
  }, { passive: false });
}

/** `pick(side, index)` chooses an image, `exchange()` swaps the sides. */
function takeKeys(view, { pick, exchange, onPoint }) {
  const move = (dx, dy) => () => view.moveBy(dx * kKeyMove, dy * kKeyMove);
  const split = (step) => () => view.setSplit(view.fraction + step * kKeySplit);
  const plain = {
    ArrowLeft: split(-1), ArrowRight: split(1), Home: () => view.setSplit(0), End: () => view.setSplit(1),
    "+": () => view.zoomBy(kKeyZoom), "=": () => view.zoomBy(kKeyZoom), "-": () => view.zoomBy(1 / kKeyZoom),
    0: () => view.fit(), x: exchange,
  };
  const shifted = {
    ArrowLeft: move(1, 0), ArrowRight: move(-1, 0), ArrowUp: move(0, 1), ArrowDown: move(0, -1),
    "+": plain["+"],
  };
  view.stage.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const action = (event.shiftKey ? shifted : plain)[event.key];
    const digit = /^(?:Digit|Numpad)([1-9])$/.exec(event.code);
    if (action) action();
    else if (digit) pick(event.shiftKey ? "left" : "right", Number(digit[1]) - 1);
    else return;
    event.preventDefault();
    // Without a pointer, the values are read in the middle.
    onPoint({ x: view.width / 2, y: view.height / 2 });
  });
}
