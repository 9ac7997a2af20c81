// The digest of page_interpreter.rs.

/** The digests of a page's steps and values; it needs nothing but its argument. */
module.exports = (page) => {
  const double = new Float64Array(1);
  const halves = new Uint32Array(double.buffer);
  return class Digest {
    constructor() {
      this.state = 0;
    }
    word(word) {
      this.state = Math.imul(this.state ^ word, 0x01000193);
      return this;
    }
    text(text) {
      this.word(text.length);
      for (let k = 0; k < text.length; k += 1) this.word(text.charCodeAt(k));
      return this;
    }
    value(value) {
      if (typeof value === "string") return this.text(value);
      if (page.isArray(value)) {
        this.word(value.rows).word(value.cols);
        for (const entry of value.entries) this.value(entry);
        return this;
      }
      double[0] = value;
      return this.word(halves[1]).word(halves[0]);
    }
    named(list) {
      this.word(list.length);
      for (const { name, subscripts, value } of list) {
        this.text(name).word(subscripts.length);
        for (const k of subscripts) this.word(k);
        this.value(value);
      }
      return this;
    }
    executed(line, { held, operands, reads, writes }) {
      const truth = (held) => (held === null ? 2 : Number(held));
      this.word(line.number).word(line.inFile).word(truth(held));
      for (const [text, held] of operands) this.text(text).word(truth(held));
      return this.named(reads).named(writes);
    }
    get result() {
      return this.state >>> 0;
    }
  };
};
