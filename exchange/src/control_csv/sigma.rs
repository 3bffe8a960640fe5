//! One standard error for all points of a list, as instruments state theirs: "2 mm + 2 ppm".
//!
//! σ_i = a + b · 10⁻⁶ · d_i, d_i the distance of point i from the centre (mean) of the list: a list does not say where its instrument stood,
//! and within the list this is how far a scale error moves a point.

use crate::reason::ExchangeReason;
use serde::{Deserialize, Serialize};

use sightline::error::{Error, Place, Reason, Result, shortened};
use sightline::project::{LARGEST, Point};
use sightline::units::Unit;

/// A constant part and one in proportion to the distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SigmaRule {
    /// The constant part.
    pub constant: f64,
    /// Its unit; null: that of the coordinates.
    #[serde(default)]
    pub unit: Option<Unit>,
    /// Millionths of the distance.
    #[serde(default)]
    pub ppm: f64,
}

impl SigmaRule {
    /// From a text: a number with its unit, "+", a number with "ppm"; either part may stand alone.
    ///
    /// # Errors
    /// [`Reason::NotANumber`] with the part that is none, [`ExchangeReason::Negative`], [`ExchangeReason::AmbiguousNumber`] for "1,234".
    pub fn read(text: &str) -> Result<Self> {
        let mut rule = Self { constant: 0.0, unit: None, ppm: 0.0 };
        let mut seen = [false; 2];
        for part in text.split('+').map(str::trim) {
            let end = part.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '\u{2212}')));
            let (number, unit) = part.split_at(end.unwrap_or(part.len()));
            let unit = unit.trim();
            let fault = |reason| Error::Invalid { reason, at: Place::field("sigma") };
            let not = || fault(Reason::NotANumber { name: "sigma".into(), text: shortened(part) });
            if super::decimals::sign_of(number) == super::decimals::Sign::Either {
                let [decimal, thousands] = super::decimals::readings(number);
                let (name, text) = ("sigma".to_owned(), shortened(number));
                return Err(fault(ExchangeReason::AmbiguousNumber { name, text, decimal, thousands }.into()));
            }
            let plain = number.replacen(',', ".", 1).replace('\u{2212}', "-");
            let value: f64 = plain.parse().map_err(|_| not())?;
            if !value.is_finite() || value > LARGEST {
                return Err(not());
            }
            if value < 0.0 {
                return Err(fault(ExchangeReason::Negative { name: "sigma".into(), value: value.into() }.into()));
            }
            let ppm = unit.eq_ignore_ascii_case("ppm");
            if std::mem::replace(&mut seen[usize::from(ppm)], true) {
                return Err(not());
            }
            if ppm {
                rule.ppm = value;
            } else {
                rule.constant = value;
                rule.unit = match unit {
                    "" => None,
                    name => Some(Unit::named(name).ok_or_else(not)?),
                };
            }
        }
        Ok(rule)
    }

    /// Gives it to all points that have none of their own, in the unit of their coordinates.
    ///
    /// # Errors
    /// [`ExchangeReason::UnitOfCoordinates`] if the rule names a unit and that of the coordinates is not known.
    pub fn apply(&self, points: &mut [Point], coordinates: Option<Unit>) -> Result<()> {
        let factor = match (self.unit, coordinates) {
            (None, _) => 1.0,
            (Some(own), Some(unit)) => own.factor(unit),
            (Some(_), None) => {
                return Err(Error::Invalid {
                    reason: ExchangeReason::UnitOfCoordinates.into(),
                    at: Place::field("sigma"),
                });
            }
        };
        let placed: Vec<[f64; 3]> = points.iter().filter_map(|point| point.xyz).collect();
        let count = placed.len().max(1) as f64;
        let centre: [f64; 3] = std::array::from_fn(|k| placed.iter().map(|xyz| xyz[k] / count).sum());
        for point in points.iter_mut().filter(|point| point.sigma.is_none()) {
            let Some(xyz) = point.xyz else { continue };
            let distance = (0..3).map(|k| (xyz[k] - centre[k]).powi(2)).sum::<f64>().sqrt();
            let sigma = self.constant * factor + self.ppm * 1e-6 * distance;
            // 0 would hold the point, which nobody asked for.
            point.sigma = (sigma > 0.0).then_some([Some(sigma); 3]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn point(id: &str, x: f64) -> Point {
        Point { id: id.into(), xyz: Some([x, 0.0, 0.0]), ..Point::default() }
    }

    #[test]
    fn rules_are_read_as_instruments_state_them() {
        let rule = |constant, unit, ppm| SigmaRule { constant, unit, ppm };
        for (text, wanted) in [
            ("2 mm + 2 ppm", rule(2.0, Some(Unit::Millimetre), 2.0)),
            ("2mm+2ppm", rule(2.0, Some(Unit::Millimetre), 2.0)),
            ("1,5 ppm + 0.5 mm", rule(0.5, Some(Unit::Millimetre), 1.5)),
            ("0,002", rule(0.002, None, 0.0)),
            ("3 PPM", rule(0.0, None, 3.0)),
        ] {
            assert_eq!(SigmaRule::read(text).unwrap(), wanted, "{text}");
        }
        for wrong in ["", "2 mm + ", "two", "2 bananas", "-1 mm", "1 mm + 2 mm", "2 ppm + 2 ppm", "1,234", "1.2.3", "+"]
        {
            assert!(SigmaRule::read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_part_in_ppm_grows_from_the_centre_of_the_list() {
        let mut points = vec![point("a", 0.0), point("b", 1000.0), point("c", 500.0)];
        points[2].sigma = Some([Some(0.1), None, None]);
        let rule = SigmaRule::read("2 mm + 2 ppm").unwrap();
        assert!(rule.apply(&mut points.clone(), None).is_err());
        rule.apply(&mut points, Some(Unit::Metre)).unwrap();
        // Half a kilometre from the centre: 2 mm + 1 mm.
        for point in &points[..2] {
            let sigma = point.sigma.unwrap()[0].unwrap();
            assert!((sigma - 0.003).abs() < 1e-12, "{sigma}");
        }
        // A standard error of its own stays.
        assert_eq!(points[2].sigma, Some([Some(0.1), None, None]));
        let mut held = vec![point("a", 1.0)];
        SigmaRule::read("0").unwrap().apply(&mut held, None).unwrap();
        assert_eq!(held[0].sigma, None);
    }
}
