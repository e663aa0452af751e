// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The controls of the page: mouse, touch, keys and panels.
import { findNames } from "./find.js";
import { $, isShape } from "./panels.js";
import { savePicture } from "./picture.js";
import { shown } from "./scale.js";
import { chosenText, quantities, views } from "./words.js";

const clickPixels = 4, tapPixels = 12, mostFound = 12;

function fill(select, choices, chosen) {
  select.replaceChildren(...choices.map(([value, text]) => Object.assign(document.createElement("option"), { value, textContent: text })));
  select.value = chosen;
}

export function fillChoices(viewer) {
  const { results, state } = viewer;
  document.title = `sunload: ${results[0].study}`;
  const chosen = chosenText(results);
  $("title").textContent = `${results[0].study}: ${results.map((result) => result.label).join(", ")}${chosen && `; ${chosen}`}`;
  $("title").title = $("title").textContent;
  const share = viewer.unmatchedShare;
  $("no-difference").hidden = !(share > 0);
  if (share > 0) {
    $("no-difference").textContent = share < 1 ? `${shown(100 * share, 2)} % of ${results[0].label} has nothing of its object in its place in ${results[1].label}: grey in the difference.` :
      "The two results share no surface: there is no difference.";
  }
  const gaps = results.filter((result) => result.lacking);
  $("lacking").hidden = !gaps.length;
  $("lacking").textContent = gaps.map((result) => `${result.label}: ${result.lacking}: totals are those of the others.`).join(" ");
  fill($("view"), views(viewer), state.view);
  $("view").parentElement.hidden = results.length < 2;
  fill($("quantity"), quantities(viewer), state.quantity);
  $("slider").max = results[0].times.length - 1;
}

/** Controls as the state is, however it came about. */
export function showState(viewer) {
  const { state, man } = viewer;
  for (const id of ["view", "quantity", "colours", "shading", "lines", "takes", "shade"]) $(id).value = state[id];
  for (const id of ["edges", "path"]) $(id).checked = state[id];
  if (document.activeElement !== $("crease")) $("crease").value = state.crease;
  $("crease").parentElement.parentElement.hidden = state.shading !== "smooth";
  $("shading").parentElement.hidden = $("colours").parentElement.hidden = isShape(state.quantity);
  $("camera").value = man.mode;
  $("pad").hidden = man.mode !== "walk";
  $("play").textContent = viewer.timer ? "stop" : "play";
  // In a narrow window choices and values are not open at once, so that there is room for the picture.
  const isFolded = { left: state.folded.has("left") || (viewer.isNarrow() && state.picked.length > 0), foot: state.folded.has("foot") };
  for (const part of ["left", "foot"]) document.body.classList.toggle(`no-${part}`, isFolded[part]);
  for (const button of document.querySelectorAll("button.fold")) button.setAttribute("aria-expanded", !isFolded[button.dataset.of]);
}

export function listen(viewer) {
  listenToChoices(viewer);
  listenToClicks(viewer);
  listenToKeys(viewer);
  listenToSearch(viewer);
  listenToPad(viewer);
}

function setCamera(viewer, mode) {
  viewer.man.setMode(mode);
  showState(viewer);
  $("scene").focus();
}

function goHome(viewer) {
  viewer.man.home();
  showState(viewer);
  viewer.touch();
}

function fold(viewer, part) {
  const { folded } = viewer.state, isOpening = document.body.classList.contains(`no-${part}`);
  isOpening ? folded.delete(part) : folded.add(part);
  viewer.change(isOpening && part === "left" && viewer.isNarrow() ? { picked: [] } : {});
}

function foldAll(viewer) {
  const { folded } = viewer.state, isAny = !folded.has("left") || !folded.has("foot");
  viewer.change({ folded: new Set(isAny ? ["left", "foot"] : []), picked: isAny ? [] : viewer.state.picked });
}

function listenToChoices(viewer) {
  for (const id of ["view", "quantity", "colours", "shading", "lines", "takes", "shade"]) $(id).addEventListener("change", () => viewer.change({ [id]: $(id).value }));
  for (const id of ["edges", "path"]) $(id).addEventListener("change", () => viewer.change({ [id]: $(id).checked }));
  $("crease").addEventListener("change", () => viewer.change({ crease: Math.min(180, Math.max(0, Number($("crease").value) || 0)) }));
  $("camera").addEventListener("change", () => setCamera(viewer, $("camera").value));
  $("home").addEventListener("click", () => goHome(viewer));
  $("slider").addEventListener("input", () => viewer.change({ k: Number($("slider").value) }));
  $("play").addEventListener("click", () => viewer.play());
  $("close").addEventListener("click", () => viewer.choose([]));
  $("fly").addEventListener("click", () => viewer.flyTo());
  $("save").addEventListener("click", () => savePicture(viewer));
  $("link").addEventListener("click", () => copyAddress(viewer));
  for (const button of document.querySelectorAll("button.fold")) button.addEventListener("click", () => fold(viewer, button.dataset.of));
  $("series").addEventListener("click", (event) => {
    if (viewer.chart?.intervalAt) viewer.change({ k: viewer.chart.intervalAt(event.offsetX) });
  });
}

/** Into the clipboard; where the browser has none, into a box to copy from. */
async function copyAddress(viewer) {
  viewer.writeAddress();
  try {
    await navigator.clipboard.writeText(window.location.href);
    $("link").textContent = "copied";
    setTimeout(() => { $("link").textContent = "link"; }, 1500);
  } catch {
    window.prompt("The address of this view:", window.location.href);
  }
}

function listenToClicks(viewer) {
  let down = null;
  const scene = $("scene"), fingers = new Set();
  scene.addEventListener("pointerdown", (event) => {
    fingers.add(event.pointerId);
    down = fingers.size === 1 && event.button === 0 ? event : null;
  });
  for (const end of ["pointercancel", "pointerleave"]) scene.addEventListener(end, (event) => fingers.delete(event.pointerId));
  scene.addEventListener("pointerup", (event) => {
    fingers.delete(event.pointerId);
    const most = event.pointerType === "mouse" ? clickPixels : tapPixels;
    if (down && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < most) {
      const entry = viewer.picker.entryAt(event.clientX, event.clientY);
      if (entry && (event.shiftKey || event.ctrlKey)) viewer.toggle(entry);
      else viewer.choose(entry ? [entry] : []);
    }
    down = null;
  });
}

function listenToKeys(viewer) {
  const does = {
    " ": () => viewer.play(), ",": () => viewer.stepTime(-1), ".": () => viewer.stepTime(1), "/": () => openSearch(viewer),
    h: () => foldAll(viewer), p: () => savePicture(viewer), o: () => setCamera(viewer, "orbit"), 0: () => goHome(viewer), Escape: () => viewer.choose([]),
  };
  window.addEventListener("keydown", (event) => {
    if (event.target.closest?.("input, select, textarea") || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.closest?.("button, summary") && (event.key === " " || event.key === "Enter")) return;
    const view = viewer.results.length > 1 && views(viewer)[Number(event.key) - 1]?.[0];
    const action = event.key === "w" && viewer.man.mode === "orbit" ? () => setCamera(viewer, "walk") : does[event.key] ?? (view && (() => viewer.change({ view })));
    if (viewer.man.key(event, true)) event.preventDefault();
    else if (action) {
      event.preventDefault();
      action();
    }
  });
  window.addEventListener("keyup", (event) => viewer.man.key(event, false));
}

function listenToPad(viewer) {
  for (const button of $("pad").children) {
    button.addEventListener("pointerdown", (event) => {
      button.setPointerCapture(event.pointerId);
      viewer.man.walk(button.dataset.way, true);
    });
    for (const end of ["pointerup", "pointercancel"]) button.addEventListener(end, () => viewer.man.walk(button.dataset.way, false));
  }
}

function openSearch(viewer) {
  viewer.state.folded.delete("left");
  showState(viewer);
  $("find").focus();
  $("find").select();
}

function listenToSearch(viewer) {
  const { known } = viewer, field = $("find"), list = $("found");
  const take = (entries) => {
    list.hidden = true;
    viewer.choose(entries);
    viewer.flyTo(entries);
  };
  const button = (text, note, entries) => {
    const made = Object.assign(document.createElement("button"), { textContent: text });
    made.append(Object.assign(document.createElement("em"), { textContent: note }));
    made.addEventListener("click", () => take(entries));
    const row = document.createElement("li");
    row.append(made);
    return row;
  };
  const note = (text) => Object.assign(document.createElement("li"), { className: "note", textContent: text });
  const show = () => {
    const { found, near, isPattern } = findNames(known, field.value), rows = [];
    if (isPattern && found.length > 1) rows.push(button(`all ${found.length}`, "that match", [{ of: "pattern", name: field.value.trim() }]));
    rows.push(...found.slice(0, mostFound).map((one) => button(one.name, one.of === "surface" ? "kind" : one.of, [one])));
    if (found.length > mostFound) rows.push(note(`and ${found.length - mostFound} more: write more of the name`));
    if (!found.length && field.value.trim()) rows.push(note(near.length ? "no such name; did you mean" : `no facade, object or kind has this name (there are ${known.length})`),
      ...near.slice(0, mostFound).map((one) => button(one.name, one.of, [one])));
    list.replaceChildren(...rows);
    list.hidden = !rows.length;
  };
  field.addEventListener("input", show);
  field.addEventListener("focus", show);
  field.addEventListener("keydown", (event) => {
    const first = list.querySelector("button");
    if (event.key === "Enter" && !list.hidden) first?.click();
    else if (event.key === "ArrowDown") first?.focus();
    else if (event.key === "Escape") {
      field.value = "";
      show();
      $("scene").focus();
    } else return;
    event.preventDefault();
  });
  list.addEventListener("keydown", (event) => {
    const buttons = [...list.querySelectorAll("button")], at = buttons.indexOf(document.activeElement);
    const next = { ArrowDown: at + 1, ArrowUp: at - 1 }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    (buttons[next] ?? (next < 0 ? field : buttons[at]))?.focus();
  });
}
