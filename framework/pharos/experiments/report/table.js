// One table per measure, one of which is shown.

/** Returns the best value of the row; NaN if the measure has no better direction or no values. */
function bestOf(values, better) {
  const numbers = values.filter((value) => !Number.isNaN(value));
  if (better === "neither" || numbers.length === 0) return NaN;
  return better === "lower" ? Math.min(...numbers) : Math.max(...numbers);
}

function tableCell(cell, best, isBaseline) {
  const value = toNumber(cell.value);
  const interval = toInterval(cell.interval);
  const element = make("td", {}, make("span", { className: "value" }, formatNumber(value)));
  if (value === best && cell.contends) {
    element.className = "best";
    element.firstChild.prepend("★ ");
    element.title = "best of its row";
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
  const contenders = row.cells.filter((cell) => cell.contends);
  const best = bestOf(contenders.map((cell) => toNumber(cell.value)), table.better);
  return make("tr", {}, make("th", { scope: "row" }, row.scene),
    ...row.cells.map((cell, i) => tableCell(cell, best, report.methods[i] === report.baseline)));
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
  if (table.better !== "neither") parts.push(`${table.better === "lower" ? "Lower" : "Higher"} is better; ★ marks the best value of a row.`);
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
