// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The manual is whole without this: it marks in the contents where one reads, and finds headings by their words.
"use strict";
{
  const nav = document.querySelector("nav"), menu = document.getElementById("menu"), filter = document.getElementById("filter");
  const links = [...nav.querySelectorAll("a")], linkTo = new Map(links.map((link) => [link.hash.slice(1), link]));
  let here = null;

  /** Marks the entry of the page that is read, and unfolds it. */
  function mark(name) {
    const link = linkTo.get(name), entry = link && link.closest("nav > ul > li");
    if (!entry || entry === here) return;
    if (here) here.classList.remove("here");
    if (here && here.querySelector("details")) here.querySelector("details").open = false;
    here = entry;
    here.classList.add("here");
    if (here.querySelector("details")) here.querySelector("details").open = true;
    if (nav.checkVisibility && nav.checkVisibility()) here.scrollIntoView({ block: "nearest" });
  }

  /** The page whose heading is the last above the middle of the window. */
  function read() {
    const middle = window.innerHeight / 2;
    const headings = [...document.querySelectorAll("article > h1")];
    const above = headings.filter((heading) => heading.getBoundingClientRect().top < middle);
    mark((above.at(-1) || headings[0]).id);
  }

  let isWaiting = false;
  window.addEventListener("scroll", () => {
    if (isWaiting) return;
    isWaiting = true;
    requestAnimationFrame(() => { isWaiting = false; read(); });
  }, { passive: true });
  nav.addEventListener("click", (event) => { if (event.target.closest("a")) menu.checked = false; });

  filter.hidden = false;
  filter.addEventListener("input", () => {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    const has = (element) => words.every((word) => element.textContent.toLowerCase().includes(word));
    for (const entry of nav.querySelectorAll(":scope > ul > li")) {
      const inner = [...entry.querySelectorAll("details li")], title = entry.querySelector("a"), found = has(title);
      for (const item of inner) item.hidden = words.length > 0 && !found && !has(item);
      entry.hidden = words.length > 0 && !found && !inner.some((item) => !item.hidden);
      const details = entry.querySelector("details");
      if (details) details.open = words.length ? !found : entry === here;
    }
    for (const list of nav.querySelectorAll(":scope > ul")) {
      list.previousElementSibling.hidden = [...list.children].every((entry) => entry.hidden);
    }
  });
  read();
}
