// Dark or light theme: initially the system's setting, then the button's.

const themeListeners = [];

/** Calls `listener` whenever the theme has changed. */
function onTheme(listener) {
  themeListeners.push(listener);
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  const button = find("theme");
  button.textContent = name === "dark" ? "Light" : "Dark";
  button.setAttribute("aria-label", `Change to the ${name === "dark" ? "light" : "dark"} theme`);
  for (const listener of themeListeners) listener();
}

function startTheme() {
  const wish = matchMedia("(prefers-color-scheme: dark)");
  const follow = () => setTheme(wish.matches ? "dark" : "light");
  follow();
  wish.addEventListener("change", follow);
  find("theme").addEventListener("click", () => setTheme(theme() === "dark" ? "light" : "dark"));
  // Printed pages are light.
  let before = theme();
  addEventListener("beforeprint", () => ((before = theme()), setTheme("light")));
  addEventListener("afterprint", () => setTheme(before));
}
