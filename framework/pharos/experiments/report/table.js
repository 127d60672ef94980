// One table per measure, one of which is shown.

/** Whether `a` is better than `b` and their intervals do not meet, or equal to `b` without intervals. */
function isAhead(a, b, better) {
  const [own, other] = [a, b].map((cell) => {
    const value = toNumber(cell.value);
    return toInterval(cell.interval) ?? { low: value, high: value };
  });
  const isTie = !a.interval && !b.interval && own.low === other.low;
  return isTie || (better === "lower" ? own.high < other.low : own.low > other.high);
}

/** Returns the cells that are ahead of all others of the row. */
function bestOf(cells, better) {
  if (better === "neither") return [];
  const contenders = cells.filter((cell) => cell.contends && !Number.isNaN(toNumber(cell.value)));
  return contenders.filter((a) => contenders.every((b) => a === b || isAhead(a, b, better)));
}

function tableCell(cell, isBest, isBaseline) {
  const value = toNumber(cell.value);
  const interval = toInterval(cell.interval);
  const element = make("td", {}, make("span", { className: "value" }, formatNumber(value)));
  if (isBest) {
    element.className = "best";
    element.firstChild.prepend("★ ");
    element.title = "better than all others of its row";
  }
  if (Number.isNaN(value)) element.title = "no value";
  if (interval) {
    element.append(make("span", { className: "interval" }, formatInterval(interval, value)));
  }
  const ratio = toNumber(cell.ratio);
  if (!Number.isNaN(ratio) && !isBaseline) {
    const bounds = toInterval(cell.ratio_interval);
    const text = `× ${formatNumber(ratio, 3)}` + (bounds ? ` ${formatInterval(bounds, ratio, 3)}` : "");
    element.append(make("span", { className: "ratio" }, text));
  }
  return element;
}

function tableRow(row, table) {
  const best = bestOf(row.cells, table.better);
  return make("tr", {}, make("th", { scope: "row" }, row.scene),
    ...row.cells.map((cell, i) => tableCell(cell, best.includes(cell), report.methods[i] === report.baseline)));
}

const capital = (text) => text[0].toUpperCase() + text.slice(1);

/** Returns a definition as a sentence with a capital letter and a period. */
function sentence(text) {
  return capital(text) + (/[.!?]$/.test(text) ? "" : ".");
}

/** Returns the explanation of the small print in the cells. */
function legendOf(table) {
  const cells = table.rows.flatMap((row) => row.cells);
  const parts = [];
  if (table.definition) parts.push(sentence(table.definition));
  if (table.better !== "neither") parts.push(`${table.better === "lower" ? "Lower" : "Higher"} is better; ★ marks a value that is better than all others of its row${cells.some((cell) => cell.interval) ? ", by intervals that do not meet" : ""}.`);
  if (cells.some((cell) => cell.interval)) parts.push("Brackets are intervals of 95 %.");
  if (cells.some((cell) => cell.ratio !== null)) parts.push(`× is the ratio to ${report.baseline || "the baseline"}.`);
  return parts.join(" ");
}

function measureTable(table) {
  const heads = report.methods.map((method) => {
    const head = make("th", { scope: "col" }, mark(method), method);
    if (method === report.baseline) head.append(make("small", {}, " (baseline)"));
    return head;
  });
  const caption = make("caption", {}, table.title);
  if (table.unit) caption.append(make("small", {}, `[${table.unit}]`));
  return make("div", { className: "measure-block" },
    make("div", { className: "scroll", tabIndex: 0 },
      make("table", { className: "measure" }, caption,
        make("thead", {}, make("tr", {}, make("th", { scope: "col" }, capital(report.subject)), ...heads)),
        make("tbody", {}, ...table.rows.map((row) => tableRow(row, table))))),
    make("p", { className: "note" }, legendOf(table)));
}

function startTables() {
  if (report.tables.length === 0) return false;
  const blocks = report.tables.map(measureTable);
  find("tables").append(...blocks);
  const select = find("measure");
  fillSelect(select, report.tables.map((table, i) => [String(i), table.title]));
  const show = () => blocks.forEach((block, i) => (block.hidden = i !== Number(select.value)));
  select.addEventListener("change", show);
  show();
  return true;
}
