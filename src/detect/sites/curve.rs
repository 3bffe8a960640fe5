//! Levels of the picture that is searched: the light's variance-stabilised root, 2 sqrt(g s + r) / g (Anscombe 1948), so that noise is the
//! same in the dark and in the light and thresholds of the search mean the same everywhere.

use super::Sites;

/// Level of the white of the sensor.
const WHITE: f64 = 60_000.0;
/// Entries of the curve.
const ENTRIES: usize = 1 << 16;

/// The root of light, in levels of 16 bits.
pub(super) struct Curve {
    levels: Vec<u16>,
    /// Light of the first level, and levels for a unit of light.
    from: f32,
    per_unit: f32,
    gain: f64,
    read: f64,
    /// Root of the least and of the most light.
    ends: [f64; 2],
}

impl Curve {
    /// From the photo's own noise.
    pub(super) fn of(sites: &Sites) -> Self {
        let black = sites.sensor.mosaic.black.largest();
        let white = (sites.clip - black).max(1.0);
        let (gain, read) = (sites.noise.gain.max(1e-6 * sites.noise.read / white), sites.noise.read);
        let dark = -4.0 * read.sqrt();
        // below black, where only the readout's noise is, the root goes on as its tangent would
        let root = |light: f64| {
            let square = gain * light.max(0.0) + read;
            2.0 * square.sqrt() / gain + light.min(0.0) / read.sqrt()
        };
        let (low, high) = (root(dark), root(white));
        let span = white - dark;
        let level = |k: usize| {
            let light = dark + span * k as f64 / (ENTRIES - 1) as f64;
            (WHITE * (root(light) - low) / (high - low)).round().clamp(0.0, WHITE) as u16
        };
        Self {
            levels: (0..ENTRIES).map(level).collect(),
            from: dark as f32,
            per_unit: ((ENTRIES - 1) as f64 / span) as f32,
            gain,
            read,
            ends: [low, high],
        }
    }

    /// Light of each level, scaled to 16 bits.
    pub(super) fn undone(&self) -> Vec<u16> {
        let Self { gain, read, ends: [low, high], .. } = *self;
        let zero = 2.0 * read.sqrt() / gain;
        let light = |root: f64| {
            if root < zero { (root - zero) * read.sqrt() } else { ((0.5 * gain * root).powi(2) - read) / gain }
        };
        let (dark, white) = (light(low), light(high));
        let of = |level: usize| {
            let root = low + (high - low) * level as f64 / WHITE;
            (WHITE * (light(root) - dark) / (white - dark)).round().clamp(0.0, WHITE) as u16
        };
        (0..=WHITE as usize).map(of).collect()
    }

    /// Levels per unit of light after the tone curve is undone.
    pub(super) fn per_light(&self) -> f64 {
        WHITE * f64::from(self.per_unit) / (ENTRIES - 1) as f64
    }

    /// The level of light.
    #[inline]
    pub(super) fn at(&self, light: f32) -> u16 {
        // the conversion makes 0 of what is negative
        let at = ((light - self.from) * self.per_unit + 0.5) as usize;
        self.levels[at.min(ENTRIES - 1)]
    }
}
