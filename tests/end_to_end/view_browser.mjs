// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A page of `sunload view`, or the manual, in headless Chromium, drawn without a graphics card.
import { createRequire } from "node:module";
import { join } from "node:path";

/** Opens pages one after the other; what goes wrong on them, and what they want of the network, is told in `seen`. */
export class Browser {
  static async start(modules, chromium, seen) {
    const playwright = createRequire(join(modules, "package.json"))("playwright-core"), one = new Browser();
    one.seen = Object.assign(seen, { errors: [], requests: [] });
    one.browser = await playwright.chromium.launch({ executablePath: chromium,
      args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--force-color-profile=srgb"] });
    return one;
  }

  /** `loaded` tells in the page that it is ready; left out: that of `sunload view`. */
  async open(address, { loaded = () => window.sunload, ...options } = {}) {
    const tab = await this.browser.newPage({ viewport: { width: 1280, height: 720 }, ...options });
    tab.on("console", (message) => ["error", "warning"].includes(message.type()) && this.seen.errors.push(message.text()));
    tab.on("pageerror", (error) => this.seen.errors.push(String(error)));
    tab.on("request", (request) => !/^(file|data|blob):/.test(request.url()) && this.seen.requests.push(request.url()));
    await tab.goto(address);
    await tab.waitForFunction(loaded, null, { timeout: 240000 });
    return tab;
  }

  close() { return this.browser.close(); }
}

/** Draws at once: a test does not wait for the next frame. */
export async function picture(tab, path) {
  await tab.evaluate(() => window.sunload.render());
  await tab.screenshot({ path });
}
