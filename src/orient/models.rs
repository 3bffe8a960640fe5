//! Models of photos from image points alone, and how they are joined to each other and to the given coordinates.

use super::DistanceSource;
use super::absolute::{self, DatumSource};
use super::block::{OrientationBlock, longer_side, set_principal_distance_px};
use super::growth::grow;
use super::plane;
use super::principal_distance;
use super::refine::{Freedom, refine};
use super::seed::{Cores, NetworkQuality, grown_out};

/// Principal distances tried, as multiples of the assumed one or of the given one, when the first leaves large
/// residuals.
const OTHER_ASSUMED: [f64; 6] = [0.8, 1.25, 1.6, 0.65, 2.8, 0.45];
const OTHER_GIVEN: [f64; 2] = [1.25, 0.8];
/// Maximum number of models.
const MOST_MODELS: usize = 8;
/// Maximum number of cores that are grown over all photos for each model, if none is certain.
const MOST_GROWN: usize = 3;

/// The photos oriented together, and those that could not be joined to them.
pub(super) struct Models {
    /// The main model.
    pub block: OrientationBlock,
    /// Source of its coordinate system; `None` while nothing is oriented.
    pub frame: Option<DatumSource>,
    /// Models of other photos, largest first.
    pub apart: Vec<OrientationBlock>,
}

impl Models {
    /// Orients what is possible from given coordinates and orientations.
    pub fn new(block: OrientationBlock) -> Self {
        let known = if block.anchored { DatumSource::Known } else { DatumSource::GivenPhotos };
        Self { frame: (block.oriented() > 0).then_some(known), block, apart: Vec::new() }
    }

    /// Orients the other photos, model by model.
    pub fn build(&mut self, sources: &[Option<DistanceSource>], fine_px: f64) {
        let mut given_up = vec![false; self.block.photos.len()];
        for _ in 0..MOST_MODELS {
            let used: Vec<bool> = (0..given_up.len()).map(|k| given_up[k] || self.holds(k)).collect();
            let left = (0..used.len()).filter(|&k| !used[k] && !self.block.photos[k].observations.is_empty()).count();
            if left < 2 {
                break;
            }
            let Some(model) = from_images(&self.block, sources, &used, fine_px) else { break };
            let new: Vec<usize> = (0..used.len()).filter(|&k| !used[k] && model.photos[k].pose.is_some()).collect();
            new.iter().for_each(|&k| given_up[k] = true);
            if new.is_empty() {
                break;
            }
            self.take(model);
            self.join_those_apart();
        }
        if self.frame == Some(DatumSource::Own) {
            // The largest model becomes the main model.
            if let Some(k) = (0..self.apart.len()).max_by_key(|&k| (self.apart[k].oriented(), std::cmp::Reverse(k)))
                && self.apart[k].oriented() > self.block.oriented()
            {
                std::mem::swap(&mut self.block, &mut self.apart[k]);
                self.join_those_apart();
            }
        }
        let main = &self.block;
        let own = |model: &OrientationBlock| {
            (0..main.photos.len()).any(|k| model.photos[k].pose.is_some() && main.photos[k].pose.is_none())
        };
        self.apart.retain(own);
        self.apart.sort_by_key(|model| std::cmp::Reverse(model.oriented()));
    }

    fn holds(&self, photo: usize) -> bool {
        std::iter::once(&self.block).chain(&self.apart).any(|model| model.photos[photo].pose.is_some())
    }

    fn take(&mut self, mut model: OrientationBlock) {
        let empty = self.block.oriented() == 0;
        if absolute::to_known(&mut model) {
            self.block = if empty { model } else { absolute::merged(self.block.clone(), model) };
            self.block.anchor();
            self.frame = Some(DatumSource::Known);
            grow(&mut self.block);
        } else if empty {
            self.block = model;
            self.frame = Some(DatumSource::Own);
        } else {
            self.apart.push(model);
        }
    }

    /// Joins other models to the main model until none can be joined.
    fn join_those_apart(&mut self) {
        while let Some((k, mut joined)) =
            (0..self.apart.len()).find_map(|k| Some((k, absolute::joined(&self.block, &self.apart[k])?)))
        {
            self.apart.remove(k);
            refine(&mut joined, Freedom::Distance);
            grow(&mut joined);
            self.block = joined;
        }
    }
}

/// A model from image points alone, started among the photos that are not used yet. If the principal distance is not certain, several
/// values are tried.
fn from_images(
    block: &OrientationBlock,
    sources: &[Option<DistanceSource>],
    used: &[bool],
    fine_px: f64,
) -> Option<OrientationBlock> {
    let fresh = block.oriented() == 0;
    let assumed: Vec<usize> =
        (0..sources.len()).filter(|&k| fresh && sources[k] == Some(DistanceSource::Assumed)).collect();
    let given: Vec<usize> = (0..sources.len()).filter(|&k| fresh && block.given_px[k].is_some()).collect();
    let others = if !assumed.is_empty() {
        &OTHER_ASSUMED[..]
    } else if !given.is_empty() {
        &OTHER_GIVEN[..]
    } else {
        &[][..]
    };
    let mut cores: Vec<(NetworkQuality, OrientationBlock)> = Vec::new();
    let mut grown: Vec<(NetworkQuality, OrientationBlock)> = Vec::new();
    for factor in std::iter::once(&1.0).chain(others) {
        let mut trial = block.clone();
        for &camera in &assumed {
            let px = principal_distance::ASSUMED * longer_side(&trial.cameras[camera]) * factor;
            set_principal_distance_px(&mut trial.cameras[camera], px);
        }
        for &camera in given.iter().filter(|_| assumed.is_empty()) {
            let px = trial.given_px[camera].unwrap_or(1.0) * factor;
            set_principal_distance_px(&mut trial.cameras[camera], px);
        }
        trial.refresh_rays();
        let pairs = Cores::new(&trial, used, fine_px);
        let few = pairs.are_of_few();
        // Plane models come last: they take longer and assume a plane object.
        let planes = std::iter::once(()).filter(|()| few).flat_map(|()| plane::cores(&trial, used, fine_px));
        for core in pairs.chain(planes) {
            let outcome = NetworkQuality::of(&core);
            if grown.len() >= MOST_GROWN || !outcome.is_evident(&core, fine_px) {
                cores.push((outcome, core));
                continue;
            }
            let model = grown_out(core, fine_px);
            let outcome = NetworkQuality::of(&model);
            if outcome.is_evident(&model, fine_px) {
                return Some(model);
            }
            grown.push((outcome, model));
        }
    }
    cores.sort_by(|(a, _), (b, _)| b.evidence.total_cmp(&a.evidence));
    for (_, core) in cores.into_iter().take(MOST_GROWN) {
        let model = grown_out(core, fine_px);
        grown.push((NetworkQuality::of(&model), model));
    }
    let best = grown.into_iter().reduce(|a, b| if b.0.evidence > a.0.evidence { b } else { a });
    best.map(|(_, model)| model).filter(|model| model.oriented() >= 2)
}
