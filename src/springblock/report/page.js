"use strict";
// Without this script the page is one long text; with it, one part at a time, with search, sorting and downloads.
const parts = [...document.querySelectorAll(".part")];
const links = [...document.querySelectorAll("nav a")];
const plain = (text) => text.toLowerCase().replace(/_/g, "").replace(/\s*(<=|>=|[=<>])\s*/g, "$1").replace(/\s+/g, " ");

function make(tag, properties) {
  return Object.assign(document.createElement(tag), properties);
}

function reveal(target) {
  const part = target.closest(".part") || parts[0];
  for (const each of parts) each.hidden = each !== part;
  for (const link of links) {
    const current = link.hash === "#" + part.id;
    if (current) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
    if (current) link.parentNode.scrollTo({ left: link.offsetLeft - link.parentNode.clientWidth / 2 + link.offsetWidth / 2 });
  }
  for (const film of document.querySelectorAll("video")) film.pause();
  for (let box = target.closest("details"); box; box = box.parentNode.closest("details")) box.open = true;
  if (target === part) scrollTo(0, 0);
  else target.scrollIntoView();
}

function show() {
  reveal(document.getElementById(decodeURIComponent(location.hash.slice(1))) || parts[0]);
}

function save(name, blob) {
  const link = make("a", { download: name, href: URL.createObjectURL(blob) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Search over all parts: the paragraphs, captions, headings and rows that hold all words.
const SEARCHED = "h1, h2, h3, p, li, dd, figcaption, summary, tbody tr";
const field = document.getElementById("search");
const results = document.getElementById("results");
let places = [];

function find() {
  const words = plain(field.value).trim().split(" ").filter(Boolean);
  results.replaceChildren();
  results.hidden = !words.length;
  if (!words.length) return;
  if (!places.length) places = [...document.querySelectorAll(SEARCHED)].filter((place) => place.closest(".part")).map((place) => [place, plain(place.textContent)]);
  const found = places.filter(([, text]) => words.every((word) => text.includes(word)));
  const shown = found.slice(0, 50);
  results.append(make("li", { textContent: `${found.length} found${found.length > 50 ? ", the first 50 shown" : ""}` }));
  for (const [place] of shown) {
    const text = place.textContent.trim().replace(/\s+/g, " ");
    const at = Math.max(0, text.toLowerCase().indexOf(words[0]) - 40);
    const button = make("button", { textContent: `${at ? "… " : ""}${text.slice(at, at + 160)}` });
    button.prepend(make("b", { textContent: `${links.find((link) => link.hash === "#" + place.closest(".part").id)?.textContent}: ` }));
    button.addEventListener("click", () => {
      history.pushState(null, "", "#" + place.closest(".part").id);
      place.hidden = false;
      reveal(place);
      results.hidden = true;
      place.classList.add("found");
      setTimeout(() => place.classList.remove("found"), 3000);
    });
    const item = make("li", {});
    item.append(button);
    results.append(item);
  }
}

// A table's search: words anywhere in a row, and conditions as n_p=6 or t_max<1e-4 on its columns.
const HOLDS = {
  "=": (a, b) => a === b || (a !== "" && Number(a) === Number(b)),
  "<": (a, b) => parseFloat(a) < Number(b),
  ">": (a, b) => parseFloat(a) > Number(b),
  "<=": (a, b) => parseFloat(a) <= Number(b),
  ">=": (a, b) => parseFloat(a) >= Number(b),
};

function condition(word, names, same) {
  const [, name, sign, value] = word.match(/^([^<>=]+)(<=|>=|[=<>])(.+)$/) || [];
  const column = names.indexOf(name);
  if (column >= 0) return (row) => HOLDS[sign](plain(row.cells[column].textContent).trim(), value);
  if (same.has(name)) return () => HOLDS[sign](plain(same.get(name)), value);
  return (row, text) => text.includes(word);
}

function search(bar, table, rows, same) {
  const input = make("input", { type: "search", placeholder: "words, or n_p=6" });
  input.setAttribute("aria-label", "Rows that hold these words or conditions");
  const count = make("output", { textContent: `${rows.length} rows` });
  const names = [...table.tHead.rows[0].cells].map((head) => plain(head.textContent.split("(")[0]).trim());
  let texts;
  input.addEventListener("input", () => {
    texts ||= rows.map((row) => plain(row.textContent));
    const tests = plain(input.value).trim().split(" ").filter(Boolean).map((word) => condition(word, names, same));
    let found = 0;
    rows.forEach((row, i) => {
      row.hidden = !tests.every((test) => test(row, texts[i]));
      found += !row.hidden;
    });
    count.textContent = `${found} of ${rows.length} rows`;
  });
  bar.append(input, count);
}

function sort(table, body, rows) {
  table.querySelectorAll("thead th").forEach((head) => {
    const button = make("button", {});
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      for (const each of head.parentNode.children) each.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      const key = new Map(rows.map((row) => [row, row.cells[head.cellIndex].textContent.trim()]));
      const by = new Intl.Collator("en", { numeric: true }).compare;
      const order = (a, b) => parseFloat(a) - parseFloat(b) || by(a, b);
      body.append(...[...rows].sort((a, b) => (up ? 1 : -1) * order(key.get(a), key.get(b))));
    });
  });
}

function csv(table, rows, same) {
  const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  const lines = [table.tHead.rows[0], ...rows].map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
  lines[0].push(...same.keys());
  for (const line of lines.slice(1)) line.push(...same.values());
  return lines.map((line) => line.map(quoted).join(",")).join("\n") + "\n";
}

for (const box of document.querySelectorAll("div.table")) {
  const table = box.querySelector("table");
  const rows = [...table.tBodies[0].rows];
  const data = box.closest(".data");
  const values = data ? [...data.querySelectorAll("[data-name]")].map((one) => [one.dataset.name, one.dataset.value]) : [];
  const bar = make("div", { className: "bar" });
  if (rows.length >= 20) search(bar, table, rows, new Map(values.map(([name, value]) => [plain(name), value])));
  if (rows.length > 1) sort(table, table.tBodies[0], rows);
  const button = make("button", { className: "save", textContent: "Save all rows as CSV" });
  const name = data ? data.id.replace("table-", "") : box.closest("[id]").id;
  button.addEventListener("click", () => save(`${name}.csv`, new Blob([csv(table, rows, new Map(values))], { type: "text/csv" })));
  bar.append(button);
  box.before(bar);
}

for (const frame of document.querySelectorAll(".frame")) {
  const picture = frame.querySelector("img");
  const enlarge = () => frame.classList.toggle("large");
  frame.addEventListener("click", enlarge);
  frame.addEventListener("keydown", (event) => event.key === "Enter" && enlarge());
  const button = make("button", { className: "save", textContent: "Save as PNG" });
  button.addEventListener("click", () => {
    const canvas = make("canvas", { width: picture.naturalWidth, height: picture.naturalHeight });
    canvas.getContext("2d").drawImage(picture, 0, 0);
    canvas.toBlob((blob) => save(`${frame.closest("[id]").id}.png`, blob));
  });
  frame.after(button);
}

field.closest(".find").hidden = false;
field.addEventListener("input", find);
field.addEventListener("focus", find);
document.addEventListener("click", (event) => field.closest(".find").contains(event.target) || (results.hidden = true));
field.addEventListener("keydown", (event) => event.key === "Escape" && ((field.value = ""), find()));
addEventListener("hashchange", show);
show();
