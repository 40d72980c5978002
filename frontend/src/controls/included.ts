// Choices of which some are made of others, as "arms" is the left arm and the right arm.

/** What a choice is made of; one that is not here stands for itself. */
export type Made = Readonly<Record<string, readonly string[]>>;

const membersOf = (choice: string, of: Made): readonly string[] => of[choice] ?? [choice];

function covered(value: readonly string[], of: Made): Set<string> {
  return new Set(value.flatMap((choice) => membersOf(choice, of)));
}

/** Whether all that a choice is made of is chosen, by itself or with others. */
export function isIncluded(choice: string, value: readonly string[], of: Made): boolean {
  const all = covered(value, of);
  return membersOf(choice, of).every((member) => all.has(member));
}

/** Take a choice in, with what it is made of, or out, whatever brought it in. In the order of the choices. */
export function toggled(
  choice: string,
  value: readonly string[],
  choices: readonly string[],
  of: Made,
): string[] {
  const mine = membersOf(choice, of);
  let next: string[];
  if (isIncluded(choice, value, of)) {
    const whole = value.filter((other) => !membersOf(other, of).some((member) => mine.includes(member)));
    const kept = covered(whole, of);
    const rest = [...covered(value, of)].filter((member) => !mine.includes(member) && !kept.has(member));
    next = [...whole, ...rest];
  } else {
    const others = value.filter((other) => !membersOf(other, of).every((member) => mine.includes(member)));
    next = [...others, choice];
  }
  return choices.filter((other) => next.includes(other));
}
