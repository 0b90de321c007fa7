// Decodes every message of every topic of MCAP files and prints, as JSON, what it found:
// node read_bag.mjs FILE.mcap ...
import { open } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";

class FileReadable {
  constructor(handle) {
    this.handle = handle;
  }
  async size() {
    return BigInt((await this.handle.stat()).size);
  }
  async read(offset, length) {
    const buffer = new Uint8Array(Number(length));
    const { bytesRead } = await this.handle.read(buffer, 0, Number(length), Number(offset));
    if (bytesRead !== Number(length)) {
      throw new Error(`${length} bytes wanted at ${offset}, ${bytesRead} there`);
    }
    return buffer;
  }
}

function numbersIn(value) {
  if (typeof value === "number") return [value];
  if (typeof value === "bigint") return [Number(value)];
  if (ArrayBuffer.isView(value)) return Array.from(value, Number);
  if (Array.isArray(value)) return value.flatMap(numbersIn);
  if (value !== null && typeof value === "object") return Object.values(value).flatMap(numbersIn);
  return [];
}

const result = {};
for (const path of process.argv.slice(2)) {
  const handle = await open(path);
  const reader = await McapIndexedReader.Initialize({
    readable: new FileReadable(handle),
    decompressHandlers: { zstd: (data, size) => decompress(data, new Uint8Array(Number(size))) },
  });
  const decoders = new Map();
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    if (schema.encoding !== "ros2msg" || channel.messageEncoding !== "cdr") {
      throw new Error(`${channel.topic}: ${schema.encoding}, ${channel.messageEncoding}`);
    }
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    decoders.set(channel.id, new MessageReader(definition));
    result[channel.topic] ??= { type: schema.name, count: 0, sum: 0, last: null };
  }
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const topic = result[reader.channelsById.get(message.channelId).topic];
    const decoded = decoders.get(message.channelId).readMessage(message.data);
    topic.count += 1;
    for (const number of numbersIn(decoded)) if (Number.isFinite(number)) topic.sum += number;
    topic.last = decoded;
  }
  await handle.close();
}
console.log(JSON.stringify(result, (_, value) => {
  if (typeof value === "bigint") return Number(value);
  return ArrayBuffer.isView(value) ? Array.from(value, Number) : value;
}));
