//! Names points by the given coordinates at their position.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::project::GivenPoint;

/// Result of a comparison with given coordinates.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Renaming {
    /// Present name, given name, distance.
    pub pairs: Vec<(String, String, f64)>,
    /// Given points with several points within the radius, or points with several given ones: none of them is renamed.
    pub ambiguous: Vec<String>,
    /// Given points with no point within the radius.
    pub not_found: Vec<String>,
}

/// Pairs each given point with the one point within `radius` of it, where it is the only given one there too; `points` in the
/// system of the given coordinates.
pub fn nearest(points: &[(String, [f64; 3])], given: &[GivenPoint], radius: f64) -> Renaming {
    let places: Vec<Vector3<f64>> = points.iter().map(|(_, xyz)| (*xyz).into()).collect();
    let near = |given: &GivenPoint| -> Vec<(usize, f64)> {
        let at = Vector3::from(given.xyz);
        let all = places.iter().enumerate().map(|(k, place)| (k, (place - at).norm()));
        all.filter(|(_, distance)| *distance <= radius).collect()
    };
    let found: Vec<Vec<(usize, f64)>> = given.iter().map(near).collect();
    let mut claims = vec![0; points.len()];
    found.iter().flatten().for_each(|(k, _)| claims[*k] += 1);
    let mut renaming = Renaming::default();
    for (given, near) in given.iter().zip(&found) {
        match near[..] {
            [] => renaming.not_found.push(given.id.clone()),
            [(k, distance)] if claims[k] == 1 => {
                renaming.pairs.push((points[k].0.clone(), given.id.clone(), distance));
            }
            _ => renaming.ambiguous.push(given.id.clone()),
        }
    }
    renaming
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn only_what_is_alone_within_the_radius_is_renamed() {
        let at = |id: &str, x: f64| (id.to_owned(), [x, 0.0, 0.0]);
        let given = |id: &str, x: f64| GivenPoint { id: id.into(), xyz: [x, 0.0, 0.0], sigma: None };
        let points = [at("a", 0.1), at("b", 10.0), at("c", 10.4), at("d", 20.0)];
        let wanted = [given("P", 0.0), given("Q", 10.2), given("R", 19.8), given("S", 20.3), given("T", 40.0)];
        let found = nearest(&points, &wanted, 0.5);
        assert_eq!(found.pairs.len(), 1);
        assert_eq!((found.pairs[0].0.as_str(), found.pairs[0].1.as_str()), ("a", "P"));
        assert_eq!(found.ambiguous, ["Q", "R", "S"]);
        assert_eq!(found.not_found, ["T"]);
    }
}
