/** What a scene is to those who cannot see it. */
export const WORDS = {
  role: { en: '3D picture', ja: '立体図' },
  label: { en: 'Field of rocks', ja: '岩の地面' },
} as const;
