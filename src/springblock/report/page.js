"use strict";
// Without this script the page is one long text; with it, one part at a time, and tables that can be searched.
const parts = [...document.querySelectorAll(".part")];
const links = [...document.querySelectorAll("nav a")];

function show() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const part = (target && target.closest(".part")) || parts[0];
  for (const each of parts) each.hidden = each !== part;
  for (const link of links) {
    if (link.hash === "#" + part.id) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
  for (const film of document.querySelectorAll("video")) film.pause();
  const box = target && target.closest("details");
  if (box) box.open = true;
  if (target && target !== part) target.scrollIntoView();
  else scrollTo(0, 0);
}

function search(box, rows) {
  const bar = document.createElement("div");
  bar.className = "search";
  const field = Object.assign(document.createElement("input"), { type: "search", placeholder: "words in a row" });
  field.setAttribute("aria-label", "Rows that hold all these words");
  const count = Object.assign(document.createElement("output"), { textContent: `${rows.length} rows` });
  const texts = rows.map((row) => row.textContent.toLowerCase());
  field.addEventListener("input", () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    let found = 0;
    rows.forEach((row, i) => {
      row.hidden = !words.every((word) => texts[i].includes(word));
      found += !row.hidden;
    });
    count.textContent = `${found} of ${rows.length} rows`;
  });
  bar.append(field, count);
  box.before(bar);
}

function sort(table, body, rows) {
  table.querySelectorAll("thead th").forEach((head, column) => {
    const button = document.createElement("button");
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      for (const each of head.parentNode.children) each.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      const key = new Map(rows.map((row) => [row, row.cells[column].textContent]));
      const by = new Intl.Collator("en", { numeric: true }).compare;
      const order = (a, b) => (isFinite(a) && isFinite(b) && a && b ? a - b : by(a, b));
      body.append(...[...rows].sort((a, b) => (up ? 1 : -1) * order(key.get(a), key.get(b))));
    });
  });
}

for (const frame of document.querySelectorAll(".frame")) {
  const enlarge = () => frame.classList.toggle("large");
  frame.addEventListener("click", enlarge);
  frame.addEventListener("keydown", (event) => event.key === "Enter" && enlarge());
}
for (const box of document.querySelectorAll("div.table")) {
  const table = box.querySelector("table");
  const rows = [...table.tBodies[0].rows];
  if (rows.length < 20) continue;
  search(box, rows);
  sort(table, table.tBodies[0], rows);
}
addEventListener("hashchange", show);
show();
