// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the manual in several widths, and tells what it saw as JSON; the last width is that of print:
//   node manual_probe.mjs FOLDER_OF_PLAYWRIGHT CHROMIUM PAGE WIDTHS
import { Browser } from "./view_browser.mjs";

const [modules, chromium, page, list] = process.argv.slice(2);
const widths = JSON.parse(list), printed = widths.pop(), seen = { widths: [] };
const browser = await Browser.start(modules, chromium, seen);
const phone = { width: 390, height: 844 };

async function measured(tab, media, width) {
  await tab.emulateMedia({ media });
  await tab.setViewportSize({ width, height: 900 });
  seen.widths.push(await tab.evaluate(([kind, wide]) => ({
    media: kind, width: wide, scrolls: document.documentElement.scrollWidth,
    pictures: [...document.images].filter((image) => !image.complete || image.naturalWidth === 0).length,
    contents: document.querySelector("nav").checkVisibility(),
  }), [media, width]));
}

try {
  const tab = await browser.open(`file://${page}#study-file`, { loaded: () => document.readyState === "complete" });
  // What the top of the page shows is marked first, and the mark follows the jump to the address some frames later.
  await tab.waitForFunction(() => {
    const marked = document.querySelector("nav .here > details > summary");
    return marked && document.getElementById("study-file").getBoundingClientRect().top < 60 && marked.textContent === "The study file";
  });
  seen.marked = await tab.evaluate(() => [...document.querySelectorAll("nav .here > details > summary")].map((entry) => entry.textContent));
  seen.top = await tab.evaluate(() => document.getElementById("study-file").getBoundingClientRect().top);
  await tab.fill("#filter", "Shadow");
  seen.found = await tab.evaluate(() => [...document.querySelectorAll("nav li li")].filter((item) => item.checkVisibility()).map((item) => item.textContent));
  await tab.fill("#filter", "");
  for (const width of widths) await measured(tab, "screen", width);
  await measured(tab, "print", printed);
  await tab.emulateMedia({ media: "screen" });
  await tab.setViewportSize(phone);
  const visible = () => tab.evaluate(() => document.querySelector("nav").checkVisibility());
  await tab.click("header label");
  seen.opened = await visible();
  await tab.click("nav .leaf a");
  seen.closed = await visible();
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));
