//! The grey picture that is searched: the sites of one colour, with the means of their nearest neighbours between them.
//!
//! Its levels are the light's variance-stabilised root, 2 sqrt(g s + r) / g (Anscombe 1948), so that noise is the same in the
//! dark and in the light: thresholds of the search mean the same everywhere. Hot sites are replaced by their neighbours.

use super::Sites;

/// Level of the white of the sensor.
const WHITE: f64 = 60_000.0;
/// Deviations by which a hot site exceeds the brightest of its neighbours.
const HOT: f64 = 8.0;

/// A picture of the lit part, and how many sites are hot.
pub(super) fn of(sites: &Sites) -> (Vec<u16>, usize) {
    let [left, top, right, bottom] = sites.lit;
    let (width, height) = (right - left, bottom - top);
    let pattern = &sites.sensor.mosaic.pattern;
    let (light, hot) = light(sites);
    let curve = Curve::of(sites);
    let mut samples = vec![0u16; width * height];
    let phases = phases(sites, true);
    for (row, line) in samples.chunks_exact_mut(width).enumerate() {
        let phases = &phases[(row + top) % pattern.height()];
        let flat: Vec<Vec<isize>> =
            phases.iter().map(|places| places.iter().map(|[dx, dy]| dy * width as isize + dx).collect()).collect();
        let inner = if row >= 2 && row + 2 < height { 2..width.saturating_sub(2).max(2) } else { 0..0 };
        for (column, sample) in line.iter_mut().enumerate() {
            let phase = (column + left) % pattern.width();
            let mean = if inner.contains(&column) {
                let at = row * width + column;
                let places = &flat[phase];
                let sum: f32 = places.iter().map(|step| light[at.wrapping_add_signed(*step)]).sum();
                sum / places.len().max(1) as f32
            } else {
                at_border(&light, [width, height], [column, row], &phases[phase])
            };
            *sample = curve.at(mean);
        }
    }
    (samples, hot)
}

/// Neighbours of every site of the pattern.
fn phases(sites: &Sites, own: bool) -> Vec<Vec<Vec<[isize; 2]>>> {
    let pattern = &sites.sensor.mosaic.pattern;
    let row = |y| (0..pattern.width()).map(|x| neighbours(sites, (x, y), own)).collect();
    (0..pattern.height()).map(row).collect()
}

/// Mean of those neighbours that the picture has.
fn at_border(light: &[f32], [width, height]: [usize; 2], [column, row]: [usize; 2], places: &[[isize; 2]]) -> f32 {
    let (mut sum, mut count) = (0.0, 0.0f32);
    for [dx, dy] in places {
        let (Some(x), Some(y)) = (column.checked_add_signed(*dx), row.checked_add_signed(*dy)) else { continue };
        if x < width && y < height {
            sum += light[y * width + x];
            count += 1.0;
        }
    }
    sum / count.max(1.0)
}

/// Light of the sites of the colour, hot ones replaced; nothing elsewhere.
fn light(sites: &Sites) -> (Vec<f32>, usize) {
    let [left, top, right, bottom] = sites.lit;
    let (width, height) = (right - left, bottom - top);
    let pattern = &sites.sensor.mosaic.pattern;
    let mut light = vec![0f32; width * height];
    for (row, line) in light.chunks_exact_mut(width).enumerate() {
        let y = row + top;
        let has: Vec<bool> = (0..pattern.width()).map(|k| sites.has(left + k, y)).collect();
        let samples = &sites.sensor.samples[y * sites.sensor.width + left..][..width];
        let black = sites.sensor.mosaic.black.of_row(y);
        let sites = line.iter_mut().zip(samples).zip(has.iter().cycle()).enumerate();
        for (column, ((light, sample), _)) in sites.filter(|(_, (_, has))| **has) {
            *light = f32::from(*sample) - black.at(column + left) as f32;
        }
    }
    let phases = phases(sites, false);
    let mut hot = Vec::new();
    for row in 2..height.saturating_sub(2) {
        let phases = &phases[(row + top) % pattern.height()];
        for column in 2..width.saturating_sub(2) {
            let own = light[row * width + column];
            let around = &phases[(column + left) % pattern.width()];
            // most sites are no brighter than the first of their neighbours
            let at =
                |[dx, dy]: &[isize; 2]| light[row.wrapping_add_signed(*dy) * width + column.wrapping_add_signed(*dx)];
            if around.is_empty() || around.iter().any(|place| at(place) >= own) {
                continue;
            }
            let brightest = around.iter().map(at).fold(f32::MIN, f32::max);
            let room = HOT * sites.noise.deviation(f64::from(brightest));
            if f64::from(own - brightest) > room && f64::from(own) > 2.0 * f64::from(brightest.max(0.0)) {
                hot.push((row * width + column, around.iter().map(at).sum::<f32>() / around.len() as f32));
            }
        }
    }
    for (at, mean) in &hot {
        light[*at] = *mean;
    }
    (light, hot.len())
}

/// Where the nearest sites of the colour lie from a site of the pattern: it itself where it has the colour and `own` is wanted.
fn neighbours(sites: &Sites, (x, y): (usize, usize), own: bool) -> Vec<[isize; 2]> {
    let pattern = &sites.sensor.mosaic.pattern;
    let (across, down) = (pattern.width() as isize, pattern.height() as isize);
    let has = |dx: isize, dy: isize| {
        let wrapped = |at: usize, step: isize, size: isize| (at as isize + step).rem_euclid(size) as usize;
        sites.has(wrapped(x, dx, across), wrapped(y, dy, down))
    };
    if has(0, 0) {
        if own {
            return vec![[0, 0]];
        }
    } else if !own {
        return Vec::new();
    }
    let places = (-2..=2).flat_map(|dy: isize| (-2..=2).map(move |dx: isize| [dx, dy]));
    let places: Vec<[isize; 2]> = places.filter(|[dx, dy]| (*dx, *dy) != (0, 0) && has(*dx, *dy)).collect();
    let square = |[dx, dy]: &[isize; 2]| dx * dx + dy * dy;
    let nearest = places.iter().map(square).min().unwrap_or(0);
    places.into_iter().filter(|place| square(place) == nearest).collect()
}

/// The root of light, in levels of 16 bits.
struct Curve {
    levels: Vec<u16>,
    /// Light of the first level, and levels for a unit of light.
    from: f32,
    per_unit: f32,
}

/// Entries of the curve.
const ENTRIES: usize = 1 << 16;

impl Curve {
    fn of(sites: &Sites) -> Self {
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
        }
    }

    #[inline]
    fn at(&self, light: f32) -> u16 {
        // the conversion makes 0 of what is negative
        let at = ((light - self.from) * self.per_unit + 0.5) as usize;
        self.levels[at.min(ENTRIES - 1)]
    }
}
