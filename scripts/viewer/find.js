// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names that a word finds: whole or parts of them, patterns with * and ?, and what one may have meant.

/** Facades, objects and kinds of surface of all results, each once, as { of, name }. */
export function knownNames(results) {
  const lists = { facade: (r) => r.geometry.facade_name, object: (r) => r.geometry.object_name, surface: (r) => r.surfaceNames() };
  return Object.entries(lists).flatMap(([of, names]) => [...new Set(results.flatMap(names))].filter((name) => name).map((name) => ({ of, name })));
}

function pattern(word) {
  const source = [...word].map((c) => (c === "*" ? ".*" : c === "?" ? "." : c.replace(/[.+^${}()|[\]\\]/, "\\$&"))).join("");
  return new RegExp(`^${source}$`, "isu");
}

/** Letters to add, leave out or change to come from one word to another (Levenshtein). */
export function editDistance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j) next[j] = Math.min(next[j - 1] + 1, row[j] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1));
    row = next;
  }
  return row[b.length];
}

/** `found`: what the word or pattern names, the best first; `near`: where there is none, what is not far from it. */
export function findNames(known, text) {
  const word = text.trim().toLowerCase();
  if (!word) return { found: [], near: [], isPattern: false };
  const isPattern = /[*?]/.test(word);
  if (isPattern) {
    const whole = pattern(word);
    const found = known.filter(({ name }) => whole.test(name));
    if (found.length) return { found, near: [], isPattern };
  } else {
    const place = ({ name }) => name.toLowerCase().indexOf(word);
    const rank = (one) => (one.name.toLowerCase() === word ? -2 : place(one) === 0 ? -1 : 0);
    const found = known.filter((one) => place(one) >= 0).sort((a, b) => rank(a) - rank(b));
    if (found.length) return { found, near: [], isPattern };
  }
  // Of a pattern its beginning counts; a third of the letters wrong is as far as a slip of the hand goes.
  const begin = word.split(/[*?]/)[0] || word.replace(/[*?]/g, "");
  const far = known.map((one) => ({ one, apart: editDistance(begin, isPattern ? one.name.toLowerCase().slice(0, begin.length) : one.name.toLowerCase()) }));
  const near = far.filter(({ apart, one }) => apart <= Math.max(1, Math.floor(Math.max(begin.length, isPattern ? 0 : one.name.length) / 3)))
    .sort((a, b) => a.apart - b.apart).map(({ one }) => one);
  return { found: [], near, isPattern };
}
