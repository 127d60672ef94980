// Texts that belong to the results. They can be read, copied and saved.

/** Returns a file name that every file system accepts. */
function fileName(title) {
  const plain = title.replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^[-.]+|-+$/g, "").slice(0, 80) || "text";
  return /\.[A-Za-z]{2,5}$/.test(plain) ? plain : `${plain}.txt`;
}

function save(title, text) {
  const link = make("a", {
    href: URL.createObjectURL(new Blob([text], { type: "text/plain" })),
    download: fileName(title),
  });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Copies by the clipboard interface. If the browser denies it to local files, copies by a selection. */
async function copy(block) {
  try {
    await navigator.clipboard.writeText(block.textContent);
  } catch {
    getSelection().selectAllChildren(block);
    if (!document.execCommand("copy")) return "Select and copy by hand";
  }
  return "Copied";
}

function textBlock({ title, text }) {
  const block = make("pre", { tabIndex: 0 }, text);
  const copyButton = make("button", { type: "button" }, "Copy");
  copyButton.addEventListener("click", async () => {
    copyButton.textContent = await copy(block);
    setTimeout(() => (copyButton.textContent = "Copy"), 2000);
  });
  const saveButton = make("button", { type: "button" }, "Download");
  saveButton.addEventListener("click", () => save(title, text));
  return make("details", {}, make("summary", {}, title),
    make("div", { className: "controls" }, copyButton, saveButton), block);
}

function startTexts() {
  find("text-list").append(...report.texts.map(textBlock));
  return report.texts.length > 0;
}
