// Texts of the server, cut for where there is little room.

/** A text as its first sentence, without the full stop, and what follows it. */
export function firstSentence(text: string): readonly [string, string] {
  const end = text.search(/\.\s/);
  return end < 0 ? [text.replace(/\.$/, ""), ""] : [text.slice(0, end), text.slice(end + 1).trim()];
}
