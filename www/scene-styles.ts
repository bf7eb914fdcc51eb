/** The style of a scene's shadow tree, shared by all elements. The first rule is the contract of replaced elements: any author rule wins. */

const STYLES = `
:host { display: block; position: relative; contain: strict; width: 300px; height: 150px; background: var(--rock-field-background, transparent) }
:host([hidden]) { display: none }
.stage, canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block }
.stage { outline: none; cursor: grab; user-select: none; -webkit-user-select: none }
.stage:active { cursor: grabbing }
.stage:focus-visible { outline: 2px solid var(--rock-field-accent, Highlight); outline-offset: -2px }
.message {
  position: absolute; inset-inline: 0; bottom: 0; box-sizing: border-box; max-height: 100%; overflow: auto; padding: .6em .9em;
  font: .875rem/1.4 system-ui, sans-serif; color: #fff; background: rgb(20 20 24 / .82); overflow-wrap: anywhere; white-space: pre-line;
}
.message[hidden] { display: none }
`;

let sheet: CSSStyleSheet | undefined;

/** A constructed sheet, since a strict content security policy refuses `<style>`. */
export function sceneStyles(): CSSStyleSheet {
  if (!sheet) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLES);
  }
  return sheet;
}
