//! The covariance of the difference of two results, from the union of their observations.
//!
//! Both results are linear functions of observations, x₁ = x₀₁ + F₁ l₁ and x₂ = x₀₂ + F₂ l₂ ([`crate::adjust::inside::influence`]). With
//! an observation's a priori standard error σᵢ and columns f₁ᵢ, f₂ᵢ of F₁ and F₂, a column of zeros for the result that it is not part
//! of, the difference d = x₂ - sR x₁ changes by gᵢ per standard error, and observations are not correlated with each other:
//!
//! ```text
//! gᵢ = sᵢ (f₂ᵢ σ₂ᵢ - sR f₁ᵢ σ₁ᵢ)        C_d = Σᵢ S gᵢ gᵢᵀ Sᵀ = C₁ + C₂ - C₁₂ - C₁₂ᵀ
//! ```
//!
//! The sum has no negative variance. If a similarity transformation between both systems was estimated, S is the S-transformation to the
//! points from which it was estimated (`ReferenceDatum`), which removes from d the part that the similarity absorbs. sᵢ² is the variance
//! factor of the result that contains the observation; for observations of both results, the mean of both factors weighted by their
//! redundancies. In equal networks a shared observation with the same standard error has gᵢ = 0; if one network is part of the other, C_d
//! is the difference of the two covariances (J. A. Hausman 1978).

use std::collections::HashMap;

use nalgebra::{Matrix3, Vector3};

use crate::adjust::inside::influence::{AdjustedQuantity, Influences, influences};
use crate::adjust::inside::linear_system::Equation;
use crate::adjustment::Adjustment;
use crate::initial::similarity::Similarity;
use crate::monitoring::covariance::ReferenceDatum;
use crate::project::{Photo, Project};

/// Maximum product of the number of observations and that of points and photos: more take longer than a few seconds in a browser, and too
/// much memory.
const LARGEST: usize = 12_000_000;
/// Given values count as the same observation if they differ by less than this share of their standard error: the frames of two
/// adjustments round them differently.
const SAME: f64 = 1e-6;

/// Compared quantities by name, in the order of the results.
pub struct ComparedQuantities<'a> {
    /// Points.
    pub points: Vec<&'a str>,
    /// Photos.
    pub photos: Vec<&'a str>,
    /// Parameters of interior orientations: camera, photo, parameter.
    pub parameters: Vec<AdjustedQuantity>,
}

/// Transformation from the earlier system into the later one.
pub struct SystemTransformation {
    /// The transform.
    pub transform: Similarity,
    /// Indices in [`ComparedQuantities::points`] of the points from which it was estimated, and the number of its parameters, 6 or 7;
    /// `None` if it was not estimated.
    pub carriers: Option<(Vec<usize>, usize)>,
}

/// Covariances of the differences, in the order of [`ComparedQuantities`].
pub struct Covariances {
    /// Of points.
    pub points: Vec<Matrix3<f64>>,
    /// Of projection centres.
    pub photos: Vec<Matrix3<f64>>,
    /// Variances of parameters.
    pub parameters: Vec<f64>,
}

/// Whether two photos are the same file: by the digest, without one by identifier and name.
pub fn same_photo(a: &Photo, b: &Photo) -> bool {
    match (a.sha256.is_empty(), b.sha256.is_empty()) {
        (false, false) => a.sha256 == b.sha256,
        _ => a.id == b.id && a.file == b.file,
    }
}

/// Covariances of the differences, later minus earlier, of the quantities `wanted`; `places` are the positions of its points and then its
/// photos in the later system. `None` if the equations of one of the documents do not reproduce its result, if a photo of both was
/// measured twice, so that the correlation of both measurements is unknown, and if the networks are too large.
pub fn covariances(
    (old, earlier): (&Project, &Adjustment),
    (new, later): (&Project, &Adjustment),
    wanted: &ComparedQuantities<'_>,
    places: &[Vector3<f64>],
    laid: &SystemTransformation,
) -> Option<Covariances> {
    let blocks = wanted.points.len() + wanted.photos.len();
    let rows = 2 * (old.observations.len() + new.observations.len());
    if rows.saturating_mul(blocks) > LARGEST {
        return None;
    }
    let axes = |id: &&str, of: fn(String, usize) -> AdjustedQuantity| {
        (0..3).map(|a| of((*id).to_owned(), a)).collect::<Vec<_>>()
    };
    let mut quantities: Vec<AdjustedQuantity> =
        wanted.points.iter().flat_map(|id| axes(id, AdjustedQuantity::Point)).collect();
    quantities.extend(wanted.photos.iter().flat_map(|id| axes(id, AdjustedQuantity::Centre)));
    quantities.extend(wanted.parameters.iter().cloned());
    let first = influences(old, earlier, &quantities).ok()?;
    let second = influences(new, later, &quantities).ok()?;
    let shared = shared(old, &first, new, &second)?;
    let datum = match &laid.carriers {
        Some((carriers, defect)) => {
            let weighted: Vec<(usize, f64)> = carriers.iter().map(|k| (*k, 1.0)).collect();
            Some(ReferenceDatum::new(places, &weighted, *defect)?)
        }
        None => None,
    };
    let [f1, f2] = [earlier, later].map(|a| a.redundancy as f64);
    let [v1, v2] = [&first, &second].map(|i| i.variance_factor);
    let both = if f1 + f2 > 0.0 { (f1 * v1 + f2 * v2) / (f1 + f2) } else { (v1 + v2) / 2.0 };
    let turn = laid.transform.rotation * laid.transform.scale;
    let mut found = Covariances {
        points: vec![Matrix3::zeros(); wanted.points.len()],
        photos: vec![Matrix3::zeros(); wanted.photos.len()],
        parameters: vec![0.0; wanted.parameters.len()],
    };
    let mut of_first = vec![0.0; quantities.len()];
    let mut of_second = vec![0.0; quantities.len()];
    let mut add = |row1: Option<usize>, row2: Option<usize>, variance: f64| {
        let s = variance.sqrt();
        of_first.fill(0.0);
        of_second.fill(0.0);
        row1.into_iter().for_each(|row| first.add(row, s, &mut of_first));
        row2.into_iter().for_each(|row| second.add(row, s, &mut of_second));
        let vector = |of: &[f64], k: usize| Vector3::new(of[3 * k], of[3 * k + 1], of[3 * k + 2]);
        let g: Vec<Vector3<f64>> = (0..blocks).map(|k| vector(&of_second, k) - turn * vector(&of_first, k)).collect();
        let g = datum.as_ref().map_or_else(|| g.clone(), |datum| datum.difference(&g));
        for (c, g) in found.points.iter_mut().chain(&mut found.photos).zip(&g) {
            *c += g * g.transpose();
        }
        for (k, c) in found.parameters.iter_mut().enumerate() {
            *c += (of_second[3 * blocks + k] - of_first[3 * blocks + k]).powi(2);
        }
    };
    let mut taken = vec![false; second.observations.len()];
    for (row, partner) in shared.iter().enumerate() {
        match partner {
            Some(other) => {
                taken[*other] = true;
                add(Some(row), Some(*other), both);
            }
            None => add(Some(row), None, v1),
        }
    }
    (0..taken.len()).filter(|row| !taken[*row]).for_each(|row| add(None, Some(row), v2));
    Some(found)
}

/// For each observation of the earlier adjustment, the index of the same observation in the later one. `None` if two measurements in one
/// photo differ.
fn shared(old: &Project, first: &Influences, new: &Project, second: &Influences) -> Option<Vec<Option<usize>>> {
    let later: HashMap<&str, &Photo> = new.photos.iter().map(|p| (p.id.as_str(), p)).collect();
    let by_digest: HashMap<&str, &Photo> =
        new.photos.iter().filter(|p| !p.sha256.is_empty()).map(|p| (p.sha256.as_str(), p)).collect();
    // Photos of the earlier project by their names in the later one.
    let renamed: HashMap<&str, &str> = (old.photos.iter())
        .filter_map(|photo| {
            let candidates = [by_digest.get(photo.sha256.as_str()), later.get(photo.id.as_str())];
            let same = candidates.into_iter().flatten().find(|other| same_photo(photo, other))?;
            Some((photo.id.as_str(), same.id.as_str()))
        })
        .collect();
    let measured = |p: &Project| -> HashMap<(String, String), [f64; 2]> {
        let enabled = p.observations.iter().filter(|o| o.enabled);
        enabled.map(|o| ((o.photo.clone(), o.point.clone()), [o.u, o.v])).collect()
    };
    let (before, after) = (measured(old), measured(new));
    for ((photo, point), place) in &before {
        let Some(name) = renamed.get(photo.as_str()) else { continue };
        if after.get(&((*name).to_owned(), point.clone())).is_some_and(|again| again != place) {
            return None;
        }
    }
    let own = |e: &Equation| named(e, |photo| renamed.get(photo).map(|name| (*name).to_owned()));
    let rows: HashMap<String, usize> = (second.observations.iter().enumerate())
        .filter_map(|(row, e)| Some((named(e, |photo| Some(photo.to_owned()))?, row)))
        .collect();
    let partner = |e: &Equation| {
        let row = *rows.get(&own(e)?)?;
        let other = &second.observations[row];
        let same = e.given.is_none() || (e.value - other.value).abs() <= SAME * e.sigma.min(other.sigma);
        same.then_some(row)
    };
    Some(first.observations.iter().map(partner).collect())
}

/// Key of an observation, with the photo's name in the later project; `None` if that project does not have the photo.
fn named(e: &Equation, later: impl Fn(&str) -> Option<String>) -> Option<String> {
    let photo = match &e.photo {
        Some(photo) => later(photo)?,
        None => String::new(),
    };
    // Names of given values contain the photo only if they belong to one.
    let name = if e.photo.is_some() { "" } else { e.name.as_str() };
    let kind = e.given.as_ref().map(std::mem::discriminant);
    let parameter = e.photo.is_some().then(|| e.name.rsplit(' ').next().unwrap_or_default());
    Some(format!("{kind:?}\n{photo}\n{:?}\n{:?}\n{name}\n{parameter:?}", e.point, e.axis))
}
