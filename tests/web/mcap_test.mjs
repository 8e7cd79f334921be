// What `swarmanoid export --mcap` writes, read by the library of the format: once by its indexes, once from front to back.
import { execFileSync, spawnSync } from 'node:child_process';
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { before, test } from 'node:test';
import { folder, experiment, load, textOf, write } from './harness.mjs';

const { McapIndexedReader, McapStreamReader, McapConstants } = load('@mcap/core');
const fzstd = load('fzstd');

const decompressHandlers = { zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))) };
const TICKS = 400;
const NS_PER_TICK = 100_000_000n;

function swarmanoid(...words) {
  return execFileSync(process.env.SWARMANOID, words, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
}

function refused(...words) {
  const run = spawnSync(process.env.SWARMANOID, words, { cwd: folder, encoding: 'utf8' });
  assert.equal(run.status, 2, run.stderr);
  return run.stderr;
}

class File {
  constructor(bytes) { this.bytes = bytes; }
  async size() { return BigInt(this.bytes.length); }
  async read(offset, length) { return new Uint8Array(this.bytes.subarray(Number(offset), Number(offset + length))); }
}

const open = (name) => McapIndexedReader.Initialize({ readable: new File(fs.readFileSync(path.join(folder, name))), decompressHandlers });

async function messages(reader, options) {
  const all = [];
  for await (const message of reader.readMessages({ ...options, validateCrcs: true }))
    all.push({ ...message, topic: reader.channelsById.get(message.channelId).topic, content: JSON.parse(Buffer.from(message.data).toString()) });
  return all;
}

function table(...words) {
  const [head, ...lines] = swarmanoid('export', 'out', '--csv', '-', ...words).trim().split('\n').map((line) => line.split(','));
  return lines.map((line) => Object.fromEntries(head.map((name, k) => [name, line[k]])));
}

before(() => {
  write('events.csv', 'tick,request,entity,numbers\n120,move,fb_3,1.5 1.25 0\n');
  write('experiment.xml', textOf('diffusion_10'));
  swarmanoid('run', 'experiment.xml', '--ticks', TICKS, '--quiet', '--no-visualisers', '--events', 'events.csv', '--output', 'out');
  swarmanoid('export', 'out', '--mcap', 'run.mcap');
});

test('the indexes lead to all messages, and the checksums are right', async () => {
  const reader = await open('run.mcap');
  const all = await messages(reader);
  assert.equal(reader.header.library, 'swarmanoid');
  assert.equal(reader.statistics.messageCount, BigInt(all.length));
  assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
  assert.ok(reader.chunkIndexes.length > 1, 'several chunks');
  assert.equal(reader.statistics.messageEndTime, BigInt(TICKS) * NS_PER_TICK);
  const count = (topic) => all.filter((message) => message.topic === topic).length;
  assert.deepEqual(['/tf_static', '/tf', '/attributes', '/events'].map(count), [1, TICKS + 1, TICKS + 1, 1]);
  assert.equal(count('/scene'), 1);
  for (const [number, channel] of reader.channelsById) {
    assert.equal(reader.statistics.channelMessageCounts.get(number), BigInt(count(channel.topic)));
    const schema = reader.schemasById.get(channel.schemaId);
    assert.equal(schema.encoding, 'jsonschema');
    assert.equal(JSON.parse(Buffer.from(schema.data).toString()).title, schema.name);
  }
  const some = await messages(reader, { topics: ['/tf'], startTime: 100n * NS_PER_TICK, endTime: 102n * NS_PER_TICK });
  assert.deepEqual(some.map((message) => message.logTime / NS_PER_TICK), [100n, 101n, 102n]);
});

test('a reader from front to back finds the same', async () => {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(fs.readFileSync(path.join(folder, 'run.mcap')));
  const counts = new Map();
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) counts.set(record.type, (counts.get(record.type) ?? 0) + 1);
  assert.ok(reader.done());
  assert.equal(BigInt(counts.get('Message')), (await open('run.mcap')).statistics.messageCount);
  assert.equal(counts.get('DataEnd'), 1);
});

test('poses and LEDs are those of the table, bit by bit', async () => {
  const all = await messages(await open('run.mcap'));
  const rows = table('--columns', 'x,y,z,qx,qy,qz,qw,led', '--entities', 'fb_*');
  const at = (topic, tick) => all.find((message) => message.topic === topic && message.logTime === BigInt(tick) * NS_PER_TICK)?.content;
  for (const row of rows.filter((one) => one.tick % 50 === 0)) {
    const transform = at('/tf', row.tick).transforms.find((one) => one.child_frame_id === row.entity);
    const { translation: p, rotation: q } = transform;
    assert.deepEqual([p.x, p.y, p.z, q.x, q.y, q.z, q.w], [row.x, row.y, row.z, row.qx, row.qy, row.qz, row.qw].map(Number));
    const { led } = at('/attributes', row.tick).entities.find((one) => one.id === row.entity);
    assert.deepEqual(led, led.map((_, k) => Number(row[`led[${k}]`])));
  }
});

test('the scene is written whole whenever LEDs change, which are where their robots have them', async () => {
  swarmanoid('run', experiment('prey_retrieval'), '--quiet', '--no-visualisers', '--output', 'prey');
  swarmanoid('export', 'prey', '--mcap', 'prey.mcap', '--until', 400);
  const all = await messages(await open('prey.mcap'));
  const at = (topic) => new Map(all.filter((message) => message.topic === topic).map((message) => [message.logTime, message.content]));
  const scenes = at('/scene');
  assert.ok(scenes.size > 1);
  let seen = 0;
  let leds;
  for (const [time, { entities }] of at('/attributes')) {
    const now = JSON.stringify(entities.map((entity) => [entity.id, entity.led ?? [], entity.colour ?? []]));
    const scene = scenes.get(time);
    assert.equal(scene !== undefined, now !== leds, `at ${time}`);
    leds = now;
    if (!scene) continue;
    assert.deepEqual(scene.deletions.map((deletion) => deletion.type), [1]);
    assert.equal(scene.entities.length, entities.length);
    for (const { id, kind, led, turret_angle: [turret] = [0] } of entities.filter((entity) => entity.led)) {
      const shown = scene.entities.find((entity) => entity.id === id);
      assert.equal(shown.frame_id, id);
      assert.ok(shown.frame_locked);
      assert.equal(shown.cylinders.length, 1);
      const lit = led.filter((colour) => colour !== 0);
      const hex = ({ r, g, b }) => ((r * 255) << 16) + ((g * 255) << 8) + b * 255;
      assert.deepEqual(shown.spheres.map((sphere) => hex(sphere.color)), lit);
      const { radius, height } = { footbot: { radius: 0.090036758, height: 0.085 }, eyebot: { radius: 0.255, height: 0.1535 } }[kind];
      led.map((colour, k) => [colour, turret + 2 * Math.PI * (k + 0.5) / led.length]).filter(([colour]) => colour !== 0).forEach(([, angle], k) => {
        const { x, y, z } = shown.spheres[k].pose.position;
        assert.ok(Math.hypot(x - radius * Math.cos(angle), y - radius * Math.sin(angle), z - height) < 1e-9, `${id} at ${time}: ${[x, y, z]}`);
      });
      seen += lit.length;
    }
  }
  assert.ok(seen > 0);
});

test('what users asked is an event', async () => {
  const [event] = await messages(await open('run.mcap'), { topics: ['/events'] });
  assert.equal(event.logTime, 120n * NS_PER_TICK);
  assert.match(event.content.message, /^move fb_3 1.5 1.25 0/);
  assert.equal(event.content.level, 2);
});

test('entities and ticks can be chosen, and the file goes to standard output', async () => {
  const bytes = execFileSync(process.env.SWARMANOID, ['export', 'out', '--mcap', '-', '--entities', 'fb_1', '--from', 100, '--until', 200, '--every', 50], { cwd: folder });
  const reader = await McapIndexedReader.Initialize({ readable: new File(bytes), decompressHandlers });
  const all = await messages(reader, { topics: ['/tf'] });
  assert.deepEqual(all.map((message) => message.logTime / NS_PER_TICK), [100n, 150n, 200n]);
  assert.deepEqual(all.map((message) => message.content.transforms.map((one) => one.child_frame_id)), [['fb_1'], ['fb_1'], ['fb_1']]);
});

test('what cannot be is refused', () => {
  assert.match(refused('export', 'out', '--mcap', 'run.mcap'), /--mcap: the file 'run.mcap' is there already; name another one/);
  assert.match(refused('export', 'out', '--mcap', 'a.mcap', '--csv', 'a.csv'), /name one format and its file/);
  assert.match(refused('export', 'out', '--mcap', 'a.mcap', '--columns', 'x'), /--columns: is of tables/);
  assert.match(refused('export', 'out', '--mcap', 'b.mcap', '--from', '9999'), /no tick of the journal is among those/);
});
