//! Observations of other kinds than image coordinates in the result: residuals, reliability, exclusions.

use crate::adjust::gross_errors::start::LEAST;
use crate::adjust::problem::additional::{self, AdditionalObservation};
use crate::adjust::problem::left_out::Key;
use crate::adjust::problem::network::InteriorBlock;
use crate::adjustment::GivenObservation;
use crate::statistics::reliability::Reliability;

use super::extent::distance;
use super::result::Solved;

impl Solved<'_> {
    /// All additional observations; those that were taken out come last.
    pub fn additional(&self) -> Vec<GivenObservation> {
        let full = self.cofactors.filter(|c| !c.rays.is_empty());
        let one = |(k, observed): (usize, AdditionalObservation)| {
            let unit = observed.unit(self.network);
            let sqrt_weight = observed.sqrt_weight(self.network);
            let factor = self.additional_factors.get(k).copied().unwrap_or(1.0);
            let residual = observed.residual(self.network, self.state);
            let mut given = GivenObservation {
                what: observed.key(self.network).named(self.project),
                residual: Some(residual * unit),
                sigma: unit / (sqrt_weight / factor),
                reliability: None,
                effect: None,
                effect_point: None,
                weight: Some(factor * factor).filter(|w| *w < 1.0),
                enabled: true,
            };
            let Some(cofactors) = full else { return given };
            let mut test = Reliability::new(
                residual * sqrt_weight,
                observed.cofactor(self.network, cofactors),
                unit / sqrt_weight,
            );
            if factor <= LEAST {
                // An observation without weight is not tested.
                test = Reliability { redundancy: test.redundancy, ..Reliability::default() };
            }
            given.reliability = Some(test);
            if let (Some(mdb), Some((shift, point))) = (test.mdb, observed.influence(self.network, cofactors)) {
                given.effect = Some(mdb * sqrt_weight / unit * shift * self.frame().scale);
                given.effect_point = Some(self.project.points[self.network.points[point].index].id.clone());
            }
            given
        };
        let used = additional::all(self.network).into_iter().enumerate().map(one);
        used.chain(self.network.left_out.iter().filter_map(|key| self.left_out(*key))).collect()
    }

    /// An additional observation that is not used any more, beside the adjusted value; it was one by its standard error in the document.
    fn left_out(&self, key: Key) -> Option<GivenObservation> {
        let network = self.network;
        let point = |index: usize| network.points.iter().position(|p| p.index == index).map(|k| self.point(k));
        let difference = |adjusted: Option<f64>, given: Option<f64>| Some(adjusted? - given?);
        let (residual, sigma) = match key {
            Key::Control(k, a) => {
                let given = &self.project.points[k];
                (difference(point(k).map(|x| x[a]), given.xyz.map(|x| x[a])), given.sigma.and_then(|s| s[a]))
            }
            Key::Position(k, a) => {
                let given = &self.project.photos[k];
                let photo = network.photos.iter().position(|p| p.index == k);
                let adjusted = photo.map(|p| self.frame().outside(self.state.poses[p].centre)[a]);
                (difference(adjusted, given.position.map(|x| x[a])), given.sigma_position.and_then(|s| s[a]))
            }
            Key::Distance(k) => {
                let given = &self.project.distances[k];
                let place = |id: &String| self.project.points.iter().position(|p| p.id == *id).and_then(point);
                let length = place(&given.from).zip(place(&given.to)).map(|(a, b)| distance(&a, &b));
                (difference(length, Some(given.length)), Some(given.sigma))
            }
            Key::Parameter(camera, photo, parameter) => {
                let own = |block: &InteriorBlock| {
                    block.camera == camera && block.photo.map(|p| network.photos[p].index) == photo
                };
                let given = &self.project.cameras[camera];
                let adjusted = network.interiors.iter().position(own).map(|k| self.state.interiors[k].get(parameter));
                (difference(adjusted.flatten(), given.interior.get(parameter)), given.sigma.get(&parameter).copied())
            }
        };
        Some(GivenObservation {
            what: key.named(self.project),
            residual,
            sigma: sigma?,
            reliability: None,
            effect: None,
            effect_point: None,
            weight: None,
            enabled: false,
        })
    }
}
