// SPDX-License-Identifier: MIT
//
// Pictures to be looked at: two sizes, light and dark, and on paper.
import { mkdirSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { setTimeout as rest } from "node:timers/promises";

import { open, options, page } from "./opened_page.mjs";

test("pictures", { skip: !options.pictures }, async () => {
  mkdirSync(options.pictures, { recursive: true });
  const to = (name) => path.join(options.pictures, name);
  for (const [name, hash] of [["watched", ""], ["lasso", ""],
                              ["thousand", "#step=540"], ["large", ""],
                              ["nasty", ""]]) {
    for (const [width, height] of [[1280, 800], [390, 844]]) {
      for (const theme of ["light", "dark"]) {
        await open(name, { hash, width, height, theme });
        await rest(150);
        const stem = `${name}-${width}x${height}-${theme}`;
        await page.picture(to(`${stem}.png`));
        if (width < 500 && theme === "light") {
          await page.picture(to(`${stem}-whole.png`), true);
        }
      }
    }
  }
  await open("watched");
  await page.print(to("watched.pdf"));
});
