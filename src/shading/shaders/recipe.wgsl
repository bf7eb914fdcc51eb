// Prepended to the passes in natural colours: what a pipeline is made for (recipe.rs). A pixel spends nothing on what is known when
// its pipeline is made, which matters most to devices that compute both sides of every branch.

// 0 low, 1 medium, 2 high
override quality: f32 = 2.0;
// Of the passes that draw the ground: 0 soil, 1 sand, 2 gravel
override ground_kind: f32 = 0.0;
override has_moss: bool = true;
override is_wet: bool = true;
override has_snow: bool = true;
override has_water: bool = true;
// Whether a log lies on the ground that is drawn.
override has_log: bool = true;
// Whether the light is that of one sample of a still.
override is_sampled: bool = false;
