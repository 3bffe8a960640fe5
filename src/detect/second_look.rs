//! The second look at a processed photo: softened, or with its sharpening undone, where something may be a target.
//!
//! What a camera does to a picture hides small and faint discs: compression scatters their edges, sharpening draws rings around them.
//! So the photo is searched once more at half of its size, softened by a Gaussian mean that leaves no more detail than that. Every blob found there
//! is a candidate; it is confirmed and measured at full resolution, in a window around it that is softened alone ([`View`]). No copy
//! of the whole photo is made.

use super::acceptance::levels::ROUNDING;
use super::acceptance::picture::{RESTORED, SOFT};
use super::acceptance::size::BLOB_LARGE;
use super::code::{self, CodeReading, outline_of};
use super::ellipse::outline::Outline;
use super::measure::Measure;
use super::normal::BLUR;
use super::pass::{Pass, disc, widen};
use super::picture::character::APART;
use super::picture::noise::{self, GOLDEN, GreyStatistics};
use super::picture::sharpening::Sharpening;
use super::picture::softened::{self, Softened};
use super::rendered::noise_autocorrelation::NoiseProducts;
use super::search::tested_outlines::TestedOutlines;
use super::search::{self, Candidate};
use super::small_targets::{self, CommonProperties, ExpectedShape, MEASURED};
use super::window::{self, Window};
use crate::detection::{DetectOptions, Method, Polarity, Reason, Target};
use crate::image::{Sample, SampleView};
use crate::ring_code::Family;

/// Half a window, in semi-major axes and pixels: the background is measured up to two radii and twelve pixels from the rim, and a rim may be
/// some pixels from where it was seen.
const AROUND: [f64; 2] = [3.2, 24.0];
/// The same for the ring of a code.
const RING_AROUND: [f64; 2] = [6.0, 24.0];
/// Side of the squares of a photo that are softened together.
const TILE: usize = 128;
/// Bands from which the noise of a view is taken, and their size in pixels.
const BANDS: usize = 24;
const BAND: [usize; 2] = [1024, 32];

/// How windows of a photo are seen.
pub(super) struct View {
    sharpening: Option<Sharpening>,
    sigma: f64,
    /// Noise and range in the levels of the view.
    levels: GreyStatistics,
    /// Its levels per level of the photo.
    scale: f64,
    /// Noise of the photo over that of the view, in the same levels; at least 1.
    averaged: f64,
    /// Squares of the photo as they are seen, row by row, as far as anything has looked there.
    tiles: Vec<Option<Vec<u16>>>,
}

impl View {
    /// A view with this sharpening undone; without one only softened.
    pub fn of<T: Sample>(plane: &SampleView<T>, own: &GreyStatistics, sharpening: Option<Sharpening>) -> Self {
        let sigma = if sharpening.is_some() { RESTORED } else { SOFT };
        let (width, height) = (plane.width.min(BAND[0]), plane.height.min(BAND[1]));
        let (mut samples, mut scale) = (Vec::new(), 1.0);
        // at multiples of the golden section the bands are spread over the whole picture
        for k in 0..BANDS {
            let [left, top] = [(plane.width - width, 1), (plane.height - height, 2)]
                .map(|(free, turns)| ((k * turns) as f64 * GOLDEN).fract() * free as f64);
            let band = Window::at(plane, [left as usize, top as usize], [width, height]);
            let band = Softened::of(&band.plane(), sharpening, sigma);
            scale = band.scale;
            samples.extend(band.samples);
        }
        let bands = SampleView::new(width, samples.len() / width.max(1), &samples);
        let levels = mean_levels(&bands, APART, own, scale);
        let averaged = (own.noise * scale / levels.noise).max(1.0);
        Self { sharpening, sigma, levels, scale, averaged, tiles: Vec::new() }
    }

    /// The window around an outline, as far as measuring looks, or reading of a ring.
    fn window<T: Sample>(&mut self, plane: &SampleView<T>, outline: &Outline, [axes, pixels]: [f64; 2]) -> Window<u16> {
        let size = 2.0 * (axes * outline.semi_axes().0 + pixels);
        let [left, top, width, height] =
            window::around([plane.width, plane.height], [outline.u, outline.v], size.ceil() as usize);
        let mut samples = vec![0; width * height];
        let columns = plane.width.div_ceil(TILE);
        self.tiles.resize_with(columns * plane.height.div_ceil(TILE), || None);
        for row in top / TILE..(top + height).div_ceil(TILE) {
            for column in left / TILE..(left + width).div_ceil(TILE) {
                let [x, y] = [column * TILE, row * TILE];
                let [tile_width, tile_height] = [TILE.min(plane.width - x), TILE.min(plane.height - y)];
                let tile = self.tiles[row * columns + column].get_or_insert_with(|| {
                    Softened::part(plane, self.sharpening, self.sigma, [x, y], [tile_width, tile_height]).samples
                });
                let [from, to] = [x.max(left), (x + tile_width).min(left + width)];
                for at in y.max(top)..(y + tile_height).min(top + height) {
                    let line = &tile[(at - y) * tile_width..][from - x..to - x];
                    samples[(at - top) * width..][from - left..to - left].copy_from_slice(line);
                }
            }
        }
        Window { left, top, width, height, samples }
    }

    /// The target that is measured in the window around an outline, in the levels of the view, and what its neighbouring pixels share.
    fn measured<T: Sample>(
        &mut self,
        plane: &SampleView<T>,
        options: &DetectOptions,
        outline: &Outline,
        measured: impl FnOnce(&mut Measure<u16>, &Outline) -> Result<(Target, Option<NoiseProducts>), Reason>,
    ) -> Result<(Target, Option<NoiseProducts>), Reason> {
        if !outline.is_proper() || 2.0 * outline.semi_axes().0 > BLOB_LARGE * options.max_diameter {
            return Err(Reason::NotAnEllipse);
        }
        let window = self.window(plane, outline, AROUND);
        let [left, top] = [window.left as f64, window.top as f64];
        let mut measure = Measure::new(window.plane(), self.levels, options);
        measure.work.coloured = true;
        measure.work.mean = self.sigma;
        let here = Outline { u: outline.u - left, v: outline.v - top, ..*outline };
        measured(&mut measure, &here).map(|(target, colour)| (target.moved([left, top]), colour))
    }

    /// What this view shows at candidates and at doubtful outlines, beyond the targets that are known. Its targets are in the levels of the photo.
    pub fn look<T: Sample>(
        &mut self,
        plane: &SampleView<T>,
        options: &DetectOptions,
        known: &[Target],
        candidates: &[Candidate],
        halved: &Halved,
    ) -> Pass {
        let mut tested = TestedOutlines::new(plane.width, plane.height, code::have_spots(options.codes));
        known.iter().for_each(|target| tested.know(target));
        let mut colours = Vec::new();
        let mut doubtful = halved.doubtful.clone();
        let confirmed = |measure: &mut Measure<u16>, outline: &Outline, bright| {
            measure.confirm(outline, bright).and_then(|found| measure.finish(&found, options.method))
        };
        for candidate in candidates {
            let Candidate { outline, bright } = *candidate;
            if !tested.is_new(candidate) {
                continue;
            }
            let measured = |measure: &mut Measure<u16>, outline: &Outline| {
                confirmed(measure, outline, bright).map(|target| (target, measure.work.noise_products()))
            };
            match self.measured(plane, options, &outline, measured) {
                Ok((target, colour)) => {
                    colours.extend(colour.map(|colour| ([target.u, target.v], colour)));
                    tested.accept(target, bright);
                }
                Err(reason) => {
                    doubtful.push(outline);
                    tested.reject(outline, bright, reason);
                }
            }
        }
        let noise = self.levels.noise;
        let again = |target: &Target| {
            let bright = target.polarity == Polarity::Bright;
            let measured =
                |measure: &mut Measure<u16>, outline: &Outline| Ok((confirmed(measure, outline, bright)?, None));
            self.measured(plane, options, &outline_of(target), measured).ok()
        };
        // only the fit of a rendered ellipse has a model to compare with
        let common = (options.method == Method::LeastSquares).then(|| {
            let known = known.iter().take(MEASURED).filter_map(again).map(|(target, _)| target);
            let all: Vec<Target> = tested.targets.iter().cloned().chain(known).collect();
            CommonProperties::of(all.iter(), noise)
        });
        if let Some(common) = common.flatten() {
            for outline in &doubtful {
                let more = SOFT * SOFT - self.sigma * self.sigma;
                if !tested.is_free(outline) || !common.stands_alone_halved(&halved.softened.plane(), outline, more) {
                    continue;
                }
                let small = |measure: &mut Measure<u16>, outline: &Outline| {
                    let target = measure.small_target(outline, &common, ExpectedShape::Disc)?;
                    Ok((target, measure.work.noise_products()))
                };
                if let Ok((target, colour)) = self.measured(plane, options, outline, small) {
                    colours.extend(colour.map(|colour| ([target.u, target.v], colour)));
                    tested.accept(target, common.bright);
                }
            }
        }
        let mut grounds = std::mem::take(&mut tested.grounds);
        let mut detection = tested.finish();
        detection.targets.iter_mut().chain(&mut grounds).for_each(|target| self.in_photo(target, options.method));
        small_targets::drop_faint(&mut detection.targets, known);
        Pass { detection, grounds, colours, coloured: true, ..Pass::default() }
    }

    /// The codes of these families in the ring around a target that was measured in this view.
    pub fn read_code<T: Sample>(
        &mut self,
        plane: &SampleView<T>,
        target: &Target,
        families: &[Family],
    ) -> Vec<CodeReading> {
        let Window { left, top, width, height, samples } = self.window(plane, &outline_of(target), RING_AROUND);
        let blur = target.quality.edge_width.hypot(self.sigma);
        let target = Target { contrast: target.contrast * self.scale, ..target.clone() };
        let target = target.moved([-(left as f64), -(top as f64)]);
        let size = plane.width.max(plane.height);
        code::read(&SampleView::new(width, height, &samples), size, &target, blur, families)
    }

    /// A target in the levels of the photo.
    fn in_photo(&self, target: &mut Target, method: Method) {
        target.contrast /= self.scale;
        target.quality.noise /= self.scale;
        // what the mean has added is none of the picture's
        let own = target.quality.edge_width.powi(2) - self.sigma * self.sigma;
        target.quality.edge_width = own.max(0.0).sqrt().max(BLUR.0);
        if method == Method::LeastSquares {
            target.quality.fit_rms /= self.scale;
        } else {
            // neighbours share the noise that a mean leaves, which only the fit counts: their mean has no less of it than that of the photo
            widen(target, self.averaged);
        }
    }
}

/// The softened photo at half of its size, and what it shows.
pub(super) struct Halved {
    softened: Softened,
    pub candidates: Vec<Candidate>,
    /// Outlines of what has no clear shape.
    doubtful: Vec<Outline>,
}

/// Searches the softened photo at half of its size.
pub(super) fn search_halved<T: Sample>(plane: &SampleView<T>, own: &GreyStatistics, options: &DetectOptions) -> Halved {
    let softened = softened::halved(plane, SOFT);
    let levels = mean_levels(&softened.plane(), APART.div_ceil(2), own, softened.scale);
    let halves = DetectOptions {
        min_diameter: options.min_diameter / 2.0,
        max_diameter: options.max_diameter / 2.0,
        ..options.clone()
    };
    let enlarged = |outline: &Outline| Outline { u: 2.0 * outline.u, v: 2.0 * outline.v, ..outline.scaled(2.0) };
    let (mut candidates, mut doubtful) = (Vec::new(), Vec::new());
    for blobs in search::search(&softened.plane(), &levels, &halves, false) {
        let enlarge = |found: Candidate| Candidate { outline: enlarged(&found.outline), ..found };
        candidates.extend(blobs.candidates.into_iter().map(enlarge));
        let shapeless = blobs.unlike.iter().chain(&blobs.shapeless);
        doubtful.extend(shapeless.filter_map(|no| disc(no, &halves)).map(|outline| enlarged(&outline)));
    }
    Halved { softened, candidates, doubtful }
}

/// Statistics of a mean of the photo with the statistics `own`: a mean has no end of the scale, and no noise less than that of rounding.
fn mean_levels(plane: &SampleView<u16>, apart: usize, own: &GreyStatistics, scale: f64) -> GreyStatistics {
    let levels = noise::levels_at(plane, apart);
    GreyStatistics {
        saturation: f64::from(u16::MAX),
        noise: levels.noise.max(ROUNDING * scale),
        stairs: false,
        developed: own.developed,
        ..levels
    }
}
