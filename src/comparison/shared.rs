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
//! The sum has no negative variance. S is the S-transformation onto the points that carried the similarity between both systems, where
//! there is one (`Datum`): it takes from d what the similarity takes up. sᵢ² is the variance factor of the result that has the
//! observation, and for observations of both the mean of both factors, weighted by their redundancies. An observation shared with the
//! same standard error in networks that are equal has gᵢ = 0; where one network is part of the other, C_d is the difference of the two
//! covariances (J. A. Hausman 1978).

use std::collections::HashMap;

use nalgebra::{Matrix3, Vector3};

use crate::adjust::inside::influence::{Influences, Quantity, influences};
use crate::adjust::inside::linear_system::Equation;
use crate::adjustment::Adjustment;
use crate::initial::similarity::Similarity;
use crate::monitoring::covariance::Datum;
use crate::project::{Photo, Project};

/// Observations times points and photos at most: more take longer than a few seconds in a browser, and memory for a number per unknown
/// and quantity.
const LARGEST: usize = 12_000_000;
/// Given values are the same observation where they differ by less than this part of their standard error: frames of two adjustments
/// round them differently.
const SAME: f64 = 1e-6;

/// What is compared, by names, in the order of the results.
pub struct Wanted<'a> {
    /// Points.
    pub points: Vec<&'a str>,
    /// Photos.
    pub photos: Vec<&'a str>,
    /// Parameters of interior orientations: camera, photo, parameter.
    pub parameters: Vec<Quantity>,
}

/// How the earlier system became the later one.
pub struct Laid {
    /// The transform.
    pub transform: Similarity,
    /// Places in [`Wanted::points`] of the points that carried it, and the number of its parameters, 6 or 7; none where it is not estimated.
    pub carriers: Option<(Vec<usize>, usize)>,
}

/// Covariances of differences, in the order of what was wanted.
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

/// Covariances of the differences later minus earlier of `wanted`, whose places in the later system are `places`: points, then photos.
/// None where the equations of one of the documents do not repeat its result, where a photo of both was measured twice, so that nothing
/// is known of how both measurements are correlated, and where the networks are too large.
pub fn covariances(
    (old, earlier): (&Project, &Adjustment),
    (new, later): (&Project, &Adjustment),
    wanted: &Wanted<'_>,
    places: &[Vector3<f64>],
    laid: &Laid,
) -> Option<Covariances> {
    let blocks = wanted.points.len() + wanted.photos.len();
    let rows = 2 * (old.observations.len() + new.observations.len());
    if rows.saturating_mul(blocks) > LARGEST {
        return None;
    }
    let axes =
        |id: &&str, of: fn(String, usize) -> Quantity| (0..3).map(|a| of((*id).to_owned(), a)).collect::<Vec<_>>();
    let mut quantities: Vec<Quantity> = wanted.points.iter().flat_map(|id| axes(id, Quantity::Point)).collect();
    quantities.extend(wanted.photos.iter().flat_map(|id| axes(id, Quantity::Centre)));
    quantities.extend(wanted.parameters.iter().cloned());
    let first = influences(old, earlier, &quantities).ok()?;
    let second = influences(new, later, &quantities).ok()?;
    let shared = shared(old, &first, new, &second)?;
    let datum = match &laid.carriers {
        Some((carriers, defect)) => {
            let weighted: Vec<(usize, f64)> = carriers.iter().map(|k| (*k, 1.0)).collect();
            Some(Datum::new(places, &weighted, *defect)?)
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

/// Which observation of the later adjustment every one of the earlier is. None where two measurements of one photo differ.
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

/// What an observation is of, with the photo's name in the later project; none of a photo that this has not.
fn named(e: &Equation, later: impl Fn(&str) -> Option<String>) -> Option<String> {
    let photo = match &e.photo {
        Some(photo) => later(photo)?,
        None => String::new(),
    };
    // What is given has the photo in its name only where it belongs to one.
    let name = if e.photo.is_some() { "" } else { e.name.as_str() };
    let kind = e.given.as_ref().map(std::mem::discriminant);
    let parameter = e.photo.is_some().then(|| e.name.rsplit(' ').next().unwrap_or_default());
    Some(format!("{kind:?}\n{photo}\n{:?}\n{:?}\n{name}\n{parameter:?}", e.point, e.axis))
}
