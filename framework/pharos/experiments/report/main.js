// Starts the page: the head, then each section that has content.

function startHead() {
  document.title = report.title;
  find("title").textContent = report.title;
  find("description").textContent = report.description;
  find("description").hidden = report.description === "";
  find("facts").append(...report.facts.map(([name, value]) =>
    make("div", {}, make("dt", {}, name), make("dd", {}, value))));
  find("facts").hidden = report.facts.length === 0;
}

const sections = {
  results: startTables, images: startComparison, convergence: startCharts,
  pictures: startPictures, texts: startTexts,
};

onTheme(paintMethods);
startTheme();
startHead();
for (const [id, start] of Object.entries(sections)) {
  // The section is shown first, because charts and images measure the space they have.
  find(id).hidden = false;
  if (start()) {
    find("contents").append(make("a", { href: `#${id}` }, find(id).querySelector("h2").textContent));
  } else {
    find(id).hidden = true;
  }
}
