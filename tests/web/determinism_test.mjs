// The answers to the hard questions, and about the hard prop, scene and shapes, are those that are published for all
// machines. With less than all random cases, a sixteenth of the questions are asked.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFile } from 'node:fs/promises';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { WASI } from 'node:wasi';

const self = fileURLToPath(import.meta.url);

if (process.argv[2] === 'run') {
  const asksFew = Number(process.env.SUREHIT_TEST_PERCENT ?? 100) < 100;
  const args = asksFew ? ['answer_hash', '--few'] : ['answer_hash'];
  const wasi = new WASI({ version: 'preview1', args, returnOnExit: true });
  const module = await WebAssembly.compile(await readFile(new URL('../../answer_hash.wasm', import.meta.url)));
  process.exitCode = wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject()));
} else {
  test('the hashes of the answers are the published ones', () => {
    const run = spawnSync(process.execPath, ['--no-warnings', self, 'run'], { encoding: 'utf8' });
    console.log(run.stdout);
    assert.equal(run.status, 0, run.stderr);
    // Twelve hashes of answers, and six of the bytes of saved colliders and scenes.
    assert.equal(run.stdout.match(/, as published/g)?.length, 18);
  });
}
