/**
 * The style of a scene's shadow tree, shared by all elements. The first rule is the contract of replaced elements: any author rule wins, but for
 * the containment, without which the picture would be laid out in whatever box is around the element. The ring of the focus comes after the
 * canvas, which would be painted over an outline of the stage's own.
 */

export const SCENE_STYLES = `
:host { display: block; position: relative; contain: strict !important; contain-intrinsic-size: 300px 150px !important; width: 300px; height: 150px; background: var(--rock-field-background, transparent) }
:host([hidden]) { display: none }
:host([disabled]) .stage, :host([interaction=none]) .stage { cursor: default }
.stage, canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block }
.stage { outline: none; cursor: grab; user-select: none; -webkit-user-select: none }
.stage:active { cursor: grabbing }
.stage:focus-visible::after {
  content: ""; position: absolute; inset: 0; pointer-events: none; outline: 2px solid var(--rock-field-accent, Highlight); outline-offset: -2px;
  box-shadow: inset 0 0 0 3px rgb(255 255 255 / .75);
}
[hidden] { display: none !important }
.waiting canvas { opacity: 0 }
.poster { position: absolute; inset: 0; display: grid; place-items: center; pointer-events: none; overflow: hidden }
.poster-image { width: 100%; height: 100%; object-fit: cover }
.progress { position: absolute; inset-inline: 0; top: 0; pointer-events: none }
.bar { height: 3px; background: var(--rock-field-accent, Highlight); transform-origin: left; transform: scaleX(var(--rock-field-progress, 0)) }
:host(:dir(rtl)) .bar { transform-origin: right }
.message slot, .message span { display: block }
.hint {
  position: absolute; inset-inline: 0; top: 50%; width: fit-content; max-width: 90%; margin-inline: auto; padding: .5em .9em; border-radius: .5em;
  box-sizing: border-box; font: .875rem/1.4 system-ui, sans-serif; text-align: center; text-wrap: balance; color: #fff; background: rgb(20 20 24 / .82);
  transform: translateY(-50%); pointer-events: none;
}
.unseen { position: absolute; width: 1px; height: 1px; overflow: clip; clip-path: inset(50%); white-space: nowrap }
.message {
  position: absolute; inset-inline: 0; bottom: 0; box-sizing: border-box; max-height: 100%; overflow: auto; padding: .6em .9em;
  font: .875rem/1.4 system-ui, sans-serif; color: #fff; background: rgb(20 20 24 / .82); overflow-wrap: anywhere; white-space: pre-line;
}
.message button { margin-top: .4em; padding: .3em .9em; font: inherit; color: inherit; background: none; border: 1px solid; border-radius: .3em; cursor: pointer }
.message button:disabled { opacity: .5 }
@media print { canvas { object-fit: contain } }
@media (forced-colors: active) { .bar { forced-color-adjust: none; background: Highlight } }
`;

/** Where the page's own rules leave the element inline (`* { all: revert }`): a box in its line, as an `<img>` is. */
export const INLINE_STYLES = ':host { display: inline-block !important }';
