// Runs an image of ports/rp2040 in rp2040js, an RP2040 emulator whose core counts cycles. Called by tools/rp2040-run:
//   run.mjs PACKAGES [--timeout SECONDS] [--map FILE --out FILE --first N --last N] IMAGE.elf [ARGUMENT]...
// The image's console, command line and exit are semihosting calls (ports/cortex-m/semihosting.c), answered here. It is
// loaded straight into the emulator's flash, without boot ROM and second-stage loader. Exit codes as of tools/qemu-run.
// --map: functions as for tools/profile/profile.c; --out then has, per line of it, the instructions and the cycles that the
// function and the helpers it called took in steps first to last.
import { createRequire } from 'node:module';
import fs from 'node:fs';

const SYS_OPEN = 0x01;
const SYS_CLOSE = 0x02;
const SYS_WRITE0 = 0x04;
const SYS_WRITE = 0x05;
const SYS_READ = 0x06;
const SYS_SEEK = 0x0a;
const SYS_RENAME = 0x0f;
const SYS_GET_CMDLINE = 0x15;
const SYS_EXIT_EXTENDED = 0x20;
const APPLICATION_EXIT = 0x20026;
const BKPT_SEMIHOSTING = 0xab;
const FLASH = 0x10000000;
const FLASH_BYTES = 2 * 1024 * 1024;
const NANOSECONDS_A_CYCLE = 8; // 125 MHz
const TIMED_OUT = 124;
const FAULT = 103;
const BAD_CALL = 2;
const INSTRUCTIONS_A_LOOK = 1 << 20; // between two looks at the time
const MODES = { 1: 'r', 5: 'w' }; // of SYS_OPEN, as ports/cortex-m/semihosting.h has them
const KINDS = ['step', 'engine', 'helper', 'aside', 'outside'];
const [STEP, , HELPER, ASIDE, OUTSIDE] = KINDS.keys();

function call(words) {
  const options = { timeout: 600, first: 1, last: Infinity };
  while (words.length > 0 && words[0].startsWith('--')) {
    const name = words.shift().slice(2);
    if (!['timeout', 'map', 'out', 'first', 'last'].includes(name) || words.length === 0) {
      throw new Error(`--${name}: unknown, or without a value`);
    }
    const value = words.shift();
    options[name] = ['map', 'out'].includes(name) ? value : Number(value);
  }
  if (words.length === 0) {
    throw new Error('needs an image');
  }
  return { ...options, image: words[0], arguments: words.slice(1) };
}

// Copies what an ELF file loads to where its program headers say.
function load(file, flash) {
  const bytes = fs.readFileSync(file);
  if (bytes.length < 52 || bytes.readUInt32BE(0) !== 0x7f454c46) {
    throw new Error(`${file}: is no ELF image`);
  }
  const [table, size, count] = [bytes.readUInt32LE(28), bytes.readUInt16LE(42), bytes.readUInt16LE(44)];
  for (let at = table; at < table + size * count; at += size) {
    const [type, offset, , physical, length] = [0, 4, 8, 12, 16].map((field) => bytes.readUInt32LE(at + field));
    if (type === 1 && length > 0) {
      if (physical < FLASH || physical + length > FLASH + FLASH_BYTES) {
        throw new Error(`${file}: loads to 0x${physical.toString(16)}, which is not flash`);
      }
      flash.set(bytes.subarray(offset, offset + length), physical - FLASH);
    }
  }
}

// Counts by function, as tools/profile/profile.c does.
class Profile {
  constructor(file, first, last) {
    this.of = new Uint16Array(FLASH_BYTES / 2); // per half-word of flash; 0 is what the map does not name
    this.entries = new Set();
    this.kinds = [HELPER];
    for (const line of fs.readFileSync(file, 'utf8').split('\n').filter(Boolean)) {
      const [low, high, kind] = line.split(' ');
      const [from, to] = [low, high].map((address) => (parseInt(address, 16) - FLASH) / 2);
      this.of.fill(this.kinds.length, from, to);
      this.kinds.push(KINDS.indexOf(kind));
      if (kind === 'step') {
        this.entries.add(from);
      }
    }
    this.instructions = new Float64Array(this.kinds.length);
    this.cycles = new Float64Array(this.kinds.length);
    [this.first, this.last, this.steps, this.inStep, this.payer] = [first, last, 0, false, 0];
  }

  executed(address, cycles) {
    const place = (address - FLASH) >> 1;
    const now = this.of[place];
    const kind = this.kinds[now];
    if (kind === ASIDE) {
      return;
    }
    if (kind === STEP && this.entries.has(place)) {
      this.steps++;
      this.inStep = true;
    }
    if (kind === OUTSIDE) {
      this.inStep = false;
    } else if (this.inStep && this.steps >= this.first && this.steps <= this.last) {
      this.payer = kind === HELPER && this.payer > 0 ? this.payer : now;
      this.instructions[this.payer]++;
      this.cycles[this.payer] += cycles;
    }
  }

  write(file) {
    const lines = Array.from(this.instructions, (count, i) => `${count} ${this.cycles[i]}\n`);
    fs.writeFileSync(file, lines.slice(1).join(''));
  }
}

// The semihosting calls that ports/cortex-m/semihosting.c makes.
class Host {
  constructor(chip, words) {
    [this.chip, this.line, this.text, this.exit] = [chip, ['cairn', ...words].join(' '), '', null];
    this.places = new Map(); // of the open files, by their handles: where the next byte is
    chip.onBreak = (number) => this.answer(number);
  }

  bytes(address, count) {
    return Buffer.from(Array.from({ length: count }, (_, i) => this.chip.readUint8(address + i)));
  }

  // Files, as ports/cortex-m/keep.c uses them.
  answerFile(operation, [first, second, third, fourth]) {
    try {
      switch (operation) {
        case SYS_OPEN: {
          const handle = fs.openSync(this.bytes(first, third).toString('latin1'), MODES[second]);
          this.places.set(handle, 0);
          return handle;
        }
        case SYS_CLOSE:
          this.places.delete(first);
          fs.closeSync(first);
          return 0;
        case SYS_SEEK:
          this.places.set(first, second);
          return 0;
        case SYS_READ: {
          const data = Buffer.alloc(third);
          const count = fs.readSync(first, data, 0, third, this.places.get(first));
          data.subarray(0, count).forEach((byte, i) => this.chip.writeUint8(second + i, byte));
          this.places.set(first, this.places.get(first) + count);
          return third - count;
        }
        case SYS_WRITE:
          return third - fs.writeSync(first, this.bytes(second, third));
        default:
          fs.renameSync(this.bytes(first, second).toString('latin1'), this.bytes(third, fourth).toString('latin1'));
          return 0;
      }
    } catch {
      return operation === SYS_READ || operation === SYS_WRITE ? third : -1;
    }
  }

  answer(number) {
    const { chip } = this;
    const [operation, block] = chip.core.registers;
    if (number === BKPT_SEMIHOSTING && operation === SYS_WRITE0) {
      for (let at = block, byte; (byte = chip.readUint8(at)) !== 0; at++) {
        this.text += String.fromCharCode(byte);
      }
      if (this.text.length > 65536) {
        this.flush();
      }
    } else if (number === BKPT_SEMIHOSTING && operation === SYS_GET_CMDLINE) {
      const [buffer, size] = [chip.readUint32(block), chip.readUint32(block + 4)];
      const bytes = Buffer.from(`${this.line}\0`, 'latin1');
      bytes.length <= size && bytes.forEach((byte, i) => chip.writeUint8(buffer + i, byte));
      chip.core.registers[0] = bytes.length <= size ? 0 : -1;
    } else if (number === BKPT_SEMIHOSTING && operation === SYS_EXIT_EXTENDED) {
      this.exit = chip.readUint32(block) === APPLICATION_EXIT ? chip.readUint32(block + 4) & 0xff : FAULT;
    } else if (number === BKPT_SEMIHOSTING && [SYS_OPEN, SYS_CLOSE, SYS_READ, SYS_WRITE, SYS_SEEK, SYS_RENAME].includes(operation)) {
      chip.core.registers[0] = this.answerFile(operation, [0, 4, 8, 12].map((field) => chip.readUint32(block + field)));
    } else {
      throw new Error(`break ${number} with operation ${operation}`);
    }
  }

  flush() {
    for (let rest = Buffer.from(this.text, 'latin1'); rest.length > 0; ) {
      rest = rest.subarray(fs.writeSync(1, rest));
    }
    this.text = '';
  }
}

function run(options, RP2040) {
  const chip = new RP2040();
  const { core, clock } = chip;
  const trouble = (where, what) => {
    throw new Error(`${where}: ${what}`);
  };
  chip.logger = { debug() {}, info() {}, warn: trouble, error: trouble };
  load(options.image, chip.flash);
  core.VTOR = FLASH;
  core.reset();
  const host = new Host(chip, options.arguments);
  const profile = options.map ? new Profile(options.map, options.first, options.last) : null;
  const end = Date.now() + 1000 * options.timeout;
  try {
    while (host.exit === null) {
      for (let i = 0; i < INSTRUCTIONS_A_LOOK && host.exit === null; i++) {
        const address = core.PC;
        const cycles = core.executeInstruction();
        clock.tick(cycles * NANOSECONDS_A_CYCLE);
        if (profile !== null) {
          profile.executed(address, cycles);
        }
      }
      if (host.exit === null && Date.now() > end) {
        host.exit = TIMED_OUT;
        process.stderr.write(`rp2040-run: ${options.image} did not end within ${options.timeout} s\n`);
      }
    }
  } catch (error) {
    process.stderr.write(`rp2040-run: at pc 0x${core.PC.toString(16)}: ${error.message}\n`);
    host.exit = FAULT;
  }
  host.flush();
  if (profile !== null && host.exit === 0) {
    profile.write(options.out);
  }
  return host.exit;
}

try {
  const [packages, ...words] = process.argv.slice(2);
  const { RP2040 } = createRequire(`${packages}/package.json`)('rp2040js');
  process.exitCode = run(call(words), RP2040);
} catch (error) {
  process.stderr.write(`rp2040-run: ${error.message}\n`);
  process.exitCode = BAD_CALL;
}
