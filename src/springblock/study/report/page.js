"use strict";
// Search, sorting and downloads; without this script the page holds the same text.
const plain = (text) => text.toLowerCase().replace(/_/g, "").replace(/\s+/g, " ").trim();
const make = (tag, properties) => Object.assign(document.createElement(tag), properties);
const holds = (text, words) => plain(words).split(" ").every((word) => text.includes(word));

function save(name, blob) {
  const link = make("a", { download: name, href: URL.createObjectURL(blob) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// The paragraphs, captions, headings and rows of the report that hold all words.
const [field, results] = ["search", "results"].map((name) => document.getElementById(name));
const places = [...document.querySelectorAll("main :is(h1, h2, h3, p, li, dd, figcaption, summary, tbody tr)")];

function reveal(place) {
  for (let box = place.closest("details"); box; box = box.parentNode.closest("details")) box.open = true;
  Object.assign(place, { hidden: false, tabIndex: -1 }).focus();
  results.hidden = true;
}

field.closest(".find").hidden = false;
field.addEventListener("input", () => {
  results.hidden = !plain(field.value);
  const found = results.hidden ? [] : places.filter((place) => holds(plain(place.textContent), field.value));
  const buttons = found.slice(0, 50).map((place) => {
    const text = place.textContent.trim().replace(/\s+/g, " ").slice(0, 160);
    const button = make("button", { textContent: `${place.closest(".part").querySelector("h1").textContent}: ${text}` });
    button.addEventListener("click", () => reveal(place));
    return button;
  });
  results.replaceChildren(make("b", { textContent: `${found.length} found` }), ...buttons);
});

function sort(head, rows) {
  const button = make("button", {});
  button.append(...head.childNodes);
  head.append(button);
  button.addEventListener("click", () => {
    const up = head.ariaSort !== "ascending";
    for (const each of head.parentNode.children) each.ariaSort = null;
    head.ariaSort = up ? "ascending" : "descending";
    const key = new Map(rows.map((row) => [row, row.cells[head.cellIndex].textContent.trim()]));
    const order = (a, b) => parseFloat(a) - parseFloat(b) || a.localeCompare(b, "en", { numeric: true });
    rows[0].parentNode.append(...[...rows].sort((a, b) => (up ? 1 : -1) * order(key.get(a), key.get(b))));
  });
}

function csv(table, same) {
  const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  const lines = [...table.rows].map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
  lines.forEach((line, i) => line.push(...same.map((one) => (i ? one.dataset.value : one.dataset.name))));
  return lines.map((line) => line.map(quoted).join(",")).join("\n") + "\n";
}

for (const box of document.querySelectorAll("div.table")) {
  const [table, bar] = [box.querySelector("table"), make("div", { className: "bar" })];
  const rows = [...table.tBodies[0].rows];
  const input = make("input", { type: "search", placeholder: "Search rows", ariaLabel: "Rows that hold these words" });
  input.addEventListener("input", () => rows.forEach((row) => (row.hidden = !holds(plain(row.textContent), input.value))));
  if (rows.length >= 20) bar.append(input);
  if (rows.length > 1) for (const head of table.tHead.querySelectorAll("th")) sort(head, rows);
  const button = make("button", { className: "save", textContent: "Save all rows as CSV" });
  const [name, same] = [box.closest("[id]").id.replace("table-", ""), box.parentNode.querySelectorAll("[data-name]")];
  button.addEventListener("click", () => save(`${name}.csv`, new Blob([csv(table, [...same])], { type: "text/csv" })));
  bar.append(button);
  box.before(bar);
}

for (const picture of document.querySelectorAll(".frame img")) {
  const button = make("button", { className: "save", textContent: "Save as PNG" });
  button.addEventListener("click", () => {
    const canvas = make("canvas", { width: picture.naturalWidth, height: picture.naturalHeight });
    canvas.getContext("2d").drawImage(picture, 0, 0);
    canvas.toBlob((blob) => save(`${picture.closest("[id]").id}.png`, blob));
  });
  picture.parentNode.after(button);
}
