// foxglove_render, heard by the public client of its protocol: what it tells is what `export --mcap` writes of the same run; who
// comes late, goes, or asks for nonsense; who is not let in.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { after, test } from 'node:test';
import { endAll, eventually, folder, freePort, load, Process, textOf, wait, write } from './harness.mjs';

const { FoxgloveClient } = load('@foxglove/ws-protocol');
const { McapIndexedReader } = load('@mcap/core');
const WebSocket = load('ws');
const fzstd = load('fzstd');

const decompressHandlers = { zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))) };
after(() => endAll('SIGKILL'));

const experiment = (visualisation) =>
  write('experiment.xml', textOf('epuck_mixed').replace(/<visualisations>[^]*<\/visualisations>/, visualisation ? `<visualisations>${visualisation}</visualisations>` : ''));

// The command, until its end.
async function command(...words) {
  const done = new Process(...words);
  assert.equal(await done.ended, 0, done.output);
}

// Opens a connection to a port and collects the messages by topic.
async function look(port, topics) {
  for (let k = 0; ; ++k) {
    try {
      const socket = new WebSocket(`ws://127.0.0.1:${port}`, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
      const client = new FoxgloveClient({ ws: socket });
      const seen = { client, socket, channels: new Map(), messages: {}, times: [], complaints: [], subscriptions: {} };
      client.on('serverInfo', (info) => { seen.info = info; });
      client.on('status', (status) => seen.complaints.push(status));
      client.on('time', ({ timestamp }) => seen.times.push(timestamp));
      client.on('advertise', (channels) => {
        for (const channel of channels) {
          seen.channels.set(channel.id, channel);
          if (topics.includes(channel.topic)) seen.subscriptions[channel.topic] = client.subscribe(channel.id);
        }
      });
      client.on('message', ({ subscriptionId, timestamp, data }) => {
        const topic = Object.keys(seen.subscriptions).find((one) => seen.subscriptions[one] === subscriptionId);
        (seen.messages[topic] ??= []).push({ timestamp, text: Buffer.from(data.buffer, data.byteOffset, data.byteLength).toString() });
      });
      await new Promise((resolve, reject) => { client.on('open', resolve); client.on('error', reject); client.on('close', reject); });
      return seen;
    } catch (error) {
      if (k > 1000) throw error;
      await wait(10);
    }
  }
}

test('what it tells is what an export has', async () => {
  const port = await freePort();
  const run = new Process('run', experiment(`<foxglove_render id="f" port="${port}"/>`), '--ticks', '200', '--real-time', '5', '--paused', '--output', 'run');
  const seen = await look(port, ['/tf_static', '/tf', '/scene', '/attributes']);
  await eventually('the first tick', () => seen.messages['/tf']);
  await command('control', 'resume');
  assert.equal(await run.ended, 0, run.output);
  assert.equal(seen.info.name, 'Swarmanoid: experiment');
  assert.deepEqual(seen.info.supportedEncodings, ['json']);
  assert.deepEqual([...seen.channels.values()].map((channel) => [channel.topic, channel.schemaName, channel.encoding, channel.schemaEncoding]), [
    ['/tf_static', 'foxglove.FrameTransforms', 'json', 'jsonschema'], ['/tf', 'foxglove.FrameTransforms', 'json', 'jsonschema'],
    ['/scene', 'foxglove.SceneUpdate', 'json', 'jsonschema'], ['/attributes', 'swarmanoid.Attributes', 'json', 'jsonschema']]);
  for (const channel of seen.channels.values()) assert.equal(JSON.parse(channel.schema).title, channel.schemaName);

  await command('export', 'run', '--mcap', 'run.mcap');
  const bytes = fs.readFileSync(path.join(folder, 'run.mcap'));
  const reader = await McapIndexedReader.Initialize({
    readable: { size: async () => BigInt(bytes.length), read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))) },
    decompressHandlers });
  const written = {};
  for await (const message of reader.readMessages())
    (written[reader.channelsById.get(message.channelId).topic] ??= new Map()).set(message.logTime, Buffer.from(message.data).toString());

  for (const topic of ['/tf', '/attributes']) {
    const messages = seen.messages[topic];
    assert.ok(messages.length > 1, `${messages.length} of ${topic}`);
    for (const { timestamp, text } of messages) assert.equal(text, written[topic].get(timestamp), `${topic} at ${timestamp}`);
    // A new client gets the present tick at once, perhaps twice.
    const times = messages.map((message) => message.timestamp);
    assert.deepEqual(times, [...times].sort((a, b) => (a < b ? -1 : a > b ? 1 : 0)));
    assert.equal(times.at(-1), 20_000_000_000n);
  }
  const withoutTimes = (text) => JSON.parse(text.replaceAll(/"timestamp":\{[^}]*\}/g, '"timestamp":0'));
  assert.deepEqual(withoutTimes(seen.messages['/tf_static'][0].text), withoutTimes([...written['/tf_static'].values()][0]));
  // A new client gets all of the scene; later messages say what changed.
  const scenes = seen.messages['/scene'].map(({ text }) => JSON.parse(text));
  assert.equal(scenes[0].entities.length, 22);
  for (const { timestamp, text } of seen.messages['/scene'].slice(1)) assert.equal(text, written['/scene'].get(timestamp));
  assert.ok(seen.times.length > 1);
});

test('attached to a paused run, it tells what is there to everybody who comes', async () => {
  const port = await freePort();
  const run = new Process('run', experiment(''), '--paused', '--output', 'paused');
  await eventually('the run', () => run.output.includes('paused') || run.code !== undefined);
  const shown = new Process('attach', 'foxglove', '--port', String(port));
  for (let round = 0; round < 2; ++round) {
    const seen = await look(port, ['/tf', '/scene']);
    await eventually('a message', () => seen.messages['/tf'] && seen.messages['/scene']);
    assert.equal(seen.messages['/tf'][0].timestamp, BigInt(round) * 500_000_000n);
    assert.equal(JSON.parse(seen.messages['/tf'][0].text).transforms.length, 17);

    seen.socket.send('{"op": "dance"}');
    seen.socket.send('{"op": "subscribe", "subscriptions": [{"id": 77, "channelId": 9}]}');
    seen.socket.send('nonsense');
    await eventually('a complaint', () => seen.complaints.length === 3);
    assert.deepEqual(seen.complaints.map(({ level }) => level), [1, 2, 2]);
    assert.equal(seen.complaints[0].message, "this server does not do 'dance'");
    assert.equal(seen.complaints[1].message, 'there is no channel 9');

    seen.client.unsubscribe(seen.subscriptions['/tf']);
    seen.socket.send('{"op": "dance"}');  // answered after that
    await eventually('an answer', () => seen.complaints.length === 4);
    const count = seen.messages['/tf'].length;
    await command('control', 'step', '5');
    await eventually('the time', () => seen.times.includes(BigInt(round + 1) * 500_000_000n));
    assert.equal(seen.messages['/tf'].length, count);
    seen.client.close();
  }
  assert.equal(await shown.end(), 130, shown.output);
  await run.end();
});

test('who is not let in', async () => {
  const port = await freePort();
  const run = new Process('run', experiment(`<foxglove_render id="f" port="${port}" origins="https://a.example, https://b.example"/>`), '--paused', '--output', 'doors');
  (await look(port, [])).client.close();
  const answer = (headers) => new Promise((resolve, reject) => {
    const request = http.request({ host: '127.0.0.1', port, headers: {
      Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': 'AAAAAAAAAAAAAAAAAAAAAA==', ...headers } });
    request.on('upgrade', (response, socket) => { socket.destroy(); resolve([response.statusCode, response.headers['sec-websocket-protocol']]); });
    request.on('response', (response) => { let text = ''; response.on('data', (data) => { text += data; }); response.on('end', () => resolve([response.statusCode, text])); });
    request.on('error', reject);
    request.end();
  });
  const protocol = { 'Sec-WebSocket-Protocol': 'other.v1, foxglove.websocket.v1' };
  assert.deepEqual(await answer(protocol), [101, 'foxglove.websocket.v1']);
  for (const origin of ['http://localhost:8080', 'http://127.0.0.1', 'file://', 'https://b.example'])
    assert.equal((await answer({ ...protocol, Origin: origin }))[0], 101, origin);
  for (const origin of ['https://evil.example', 'http://localhost.evil.example', 'http://127.0.0.1.evil.example:80', 'https://b.example.org']) {
    const [status, text] = await answer({ ...protocol, Origin: origin });
    assert.equal(status, 403, origin);
    assert.match(text, /are not let in; the parameter origins names/);
  }
  assert.deepEqual(await answer({ 'Sec-WebSocket-Protocol': 'other.v1' }), [400, 'the subprotocol is foxglove.websocket.v1\n']);
  assert.equal((await answer({ Connection: 'close', Upgrade: '' }))[0], 426);

  const second = new Process('run', experiment(`<foxglove_render id="f" port="${port}"/>`), '--single-process', '--output', 'second');
  assert.notEqual(await second.ended, 0);
  assert.match(second.output, new RegExp(`cannot listen at 127.0.0.1:${port}: Address already in use; choose another <port>`));
  await run.end();
});
