// A window over the page: Escape and a click beside it close it, and the focus goes back.

/** Attach to a <dialog>: it opens, and says when it is to be closed by taking it away. */
export function modal(onclose: () => void): (dialog: HTMLDialogElement) => () => void {
  return (dialog) => {
    const before = document.activeElement;
    const listening = new AbortController();
    const { signal } = listening;
    // "cancel" comes with Escape itself. "close" comes a frame later: keys pressed until then would be lost.
    for (const said of ["cancel", "close"]) dialog.addEventListener(said, onclose, { signal });
    dialog.addEventListener("click", (event) => event.target === dialog && onclose(), { signal });
    dialog.showModal();
    return () => {
      listening.abort(); // what this one still says is nothing to a dialog that opens next
      dialog.close();
      if (before instanceof HTMLElement) before.focus();
    };
  };
}
