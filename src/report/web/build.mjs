// In: the page's sources, with node_modules beside them (scripts/web brings both together). Out: the page in one file.
// usage: node build.mjs OUT
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import * as esbuild from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const common = { bundle: true, minify: true, write: false, charset: 'ascii', legalComments: 'none', logLevel: 'warning', target: 'es2022' };
const script = await esbuild.build({ ...common, entryPoints: [join(here, 'src/main.ts')], format: 'iife', tsconfig: join(here, 'tsconfig.json') });
const style = await esbuild.build({ ...common, stdin: { contents: '@import "uplot/dist/uPlot.min.css"; @import "./src/style.css";', loader: 'css', resolveDir: here } });

const text = result => result.outputFiles[0].text.trim();
const hash = content => createHash('sha256').update(content, 'utf8').digest('base64');
const bundled = text(script), styled = text(style);
for (const [name, content, forbidden] of [['script', bundled, /<\/script|<!--/i], ['style', styled, /<\/style/i]])
    if (forbidden.test(content)) throw new Error(`the ${name} has ${forbidden} in it, which would end it early`);
const parts = { STYLE: styled, SCRIPT: bundled, SCRIPT_HASH: hash(bundled), STYLE_HASH: hash(styled) };
const page = readFileSync(join(here, 'page.template.html'), 'utf8').replace(/@(STYLE|SCRIPT|SCRIPT_HASH|STYLE_HASH)@/g, (_, name) => parts[name]);
if (/[^\x00-\x7f]/.test(page)) throw new Error('the page has to be ASCII, since the program embeds it');
writeFileSync(process.argv[2], page);
