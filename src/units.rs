//! Units of length: a closed list with exact factors, and the names by which people write them.
//!
//! Factors are ratios of whole micrometres: 1 in = 25 400 µm and 1 ft = 304 800 µm (international yard and pound agreement, 1959),
//! 1 US survey foot = 1200/3937 m (Mendenhall order, 1893). A name that is not in the list is an error; it never counts as
//! a factor of 1.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Place, Reason, Result, shortened};

/// A unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Unit {
    /// Micrometre.
    #[serde(rename = "µm")]
    Micrometre,
    /// Millimetre.
    #[serde(rename = "mm")]
    Millimetre,
    /// Centimetre.
    #[serde(rename = "cm")]
    Centimetre,
    /// Decimetre.
    #[serde(rename = "dm")]
    Decimetre,
    /// Metre.
    #[serde(rename = "m")]
    Metre,
    /// Kilometre.
    #[serde(rename = "km")]
    Kilometre,
    /// Inch of 25.4 mm.
    #[serde(rename = "in")]
    Inch,
    /// International foot of 304.8 mm.
    #[serde(rename = "ft")]
    Foot,
    /// US survey foot of 1200/3937 m.
    #[serde(rename = "ft-us")]
    SurveyFoot,
    /// International yard of 914.4 mm.
    #[serde(rename = "yd")]
    Yard,
}

impl Unit {
    /// All units, the most common first.
    pub const ALL: [Self; 10] = [
        Self::Millimetre,
        Self::Centimetre,
        Self::Metre,
        Self::Micrometre,
        Self::Decimetre,
        Self::Kilometre,
        Self::Inch,
        Self::Foot,
        Self::SurveyFoot,
        Self::Yard,
    ];

    /// Its symbol, as documents have it.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Micrometre => "µm",
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Decimetre => "dm",
            Self::Metre => "m",
            Self::Kilometre => "km",
            Self::Inch => "in",
            Self::Foot => "ft",
            Self::SurveyFoot => "ft-us",
            Self::Yard => "yd",
        }
    }

    /// Length in micrometres, as a ratio of whole numbers.
    fn micrometres(self) -> [f64; 2] {
        match self {
            Self::Micrometre => [1.0, 1.0],
            Self::Millimetre => [1e3, 1.0],
            Self::Centimetre => [1e4, 1.0],
            Self::Decimetre => [1e5, 1.0],
            Self::Metre => [1e6, 1.0],
            Self::Kilometre => [1e9, 1.0],
            Self::Inch => [25_400.0, 1.0],
            Self::Foot => [304_800.0, 1.0],
            Self::SurveyFoot => [1.2e9, 3937.0],
            Self::Yard => [914_400.0, 1.0],
        }
    }

    /// Other names, in lower case.
    fn names(self) -> &'static [&'static str] {
        match self {
            Self::Micrometre => &[
                "um",
                "μm",
                "㎛",
                "micron",
                "microns",
                "micrometre",
                "micrometer",
                "micrometres",
                "micrometers",
                "mikrometer",
                "마이크로미터",
                "마이크론",
            ],
            Self::Millimetre => &["㎜", "millimetre", "millimeter", "millimetres", "millimeters", "밀리미터", "밀리"],
            Self::Centimetre => &[
                "㎝",
                "centimetre",
                "centimeter",
                "centimetres",
                "centimeters",
                "zentimeter",
                "센티미터",
                "센티",
                "센치",
            ],
            Self::Decimetre => &["㍷", "decimetre", "decimeter", "decimetres", "decimeters", "dezimeter", "데시미터"],
            Self::Metre => &["metre", "meter", "metres", "meters", "mtr", "미터"],
            Self::Kilometre => &["㎞", "kilometre", "kilometer", "kilometres", "kilometers", "킬로미터"],
            Self::Inch => &["inch", "inches", "zoll", "인치"],
            Self::Foot => &["foot", "feet", "international foot", "international feet", "ft-int", "피트"],
            Self::SurveyFoot => &[
                "us-ft",
                "usft",
                "ftus",
                "ft us",
                "us ft",
                "ft_us",
                "us_ft",
                "us foot",
                "us feet",
                "survey foot",
                "survey feet",
                "us survey foot",
                "us survey feet",
                "측량피트",
                "측량 피트",
                "미국 측량 피트",
            ],
            Self::Yard => &["yard", "yards", "야드"],
        }
    }

    /// The unit that a text names: a symbol or a common name, in any case; `None` for any other text.
    pub fn named(text: &str) -> Option<Self> {
        let text = text.trim().trim_end_matches('.').to_lowercase();
        Self::ALL.into_iter().find(|unit| unit.symbol() == text || unit.names().contains(&text.as_str()))
    }

    /// The unit that a text names.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the place and the list of units for a text that names none.
    pub fn known(text: &str, at: Place) -> Result<Self> {
        let reason = || Reason::NoneOf { name: "unit".into(), choices: Self::list(), text: shortened(text) };
        Self::named(text).ok_or_else(|| Error::Invalid { reason: reason(), at })
    }

    /// The symbols of all units, for a sentence.
    pub fn list() -> String {
        Self::ALL.map(Self::symbol).join(", ")
    }

    /// Length in millimetres.
    pub fn millimetres(self) -> f64 {
        self.factor(Self::Millimetre)
    }

    /// Factor that converts a length in this unit to another unit, correctly rounded.
    pub fn factor(self, to: Self) -> f64 {
        let ([a, b], [c, d]) = (self.micrometres(), to.micrometres());
        // Whole numbers below 2^53: only the division rounds.
        (a * d) / (b * c)
    }
}

/// Factor that converts a length between two units given by name. The same text has the factor 1, known or not.
///
/// # Errors
/// [`Error::Invalid`] with the field `unit` and the list of units for an unknown name.
pub fn factor(from: &str, to: &str) -> Result<f64> {
    if from == to {
        return Ok(1.0);
    }
    let at = || Place::field("unit");
    Ok(Unit::known(from, at())?.factor(Unit::known(to, at())?))
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn factors_are_exact() {
        use Unit as U;
        for (from, to, factor) in [
            (U::Inch, U::Centimetre, 2.54),
            (U::Metre, U::Millimetre, 1000.0),
            (U::Millimetre, U::Metre, 0.001),
            (U::Micrometre, U::Metre, 1e-6),
            (U::Foot, U::Inch, 12.0),
            (U::Yard, U::Foot, 3.0),
            (U::SurveyFoot, U::Metre, 1200.0 / 3937.0),
            (U::Metre, U::SurveyFoot, 3937.0 / 1200.0),
            (U::Kilometre, U::Decimetre, 1e4),
        ] {
            assert_eq!(from.factor(to), factor, "{from:?} {to:?}");
        }
        for a in U::ALL {
            for b in U::ALL {
                assert!((a.factor(b) * b.factor(a) - 1.0).abs() < 4.0 * f64::EPSILON);
            }
        }
    }

    #[test]
    fn every_name_names_one_unit_in_any_case() {
        let mut seen = std::collections::HashSet::new();
        for unit in Unit::ALL {
            for name in unit.names().iter().copied().chain([unit.symbol()]) {
                assert!(seen.insert(name), "{name} twice");
                for written in [name.to_owned(), format!(" {name}. "), name.to_uppercase()] {
                    assert_eq!(Unit::named(&written), Some(unit), "{written}");
                }
            }
            let json = serde_json::to_string(&unit).unwrap();
            assert_eq!(json, format!("\"{}\"", unit.symbol()));
        }
    }

    #[test]
    fn what_is_no_unit_is_an_error_with_the_list() {
        for text in ["banana", "", "x", "mm2", "furlong", "ell"] {
            let error = Unit::known(text, Place::field("unit")).unwrap_err();
            assert_eq!(error.place().field.as_deref(), Some("unit"));
            assert!(error.to_string().contains("mm, cm, m") && error.to_string().contains("ft-us"), "{error}");
            assert!(factor(text, "mm").is_err() && factor("mm", text).is_err());
            assert_eq!(factor(text, text), Ok(1.0));
        }
        assert_eq!(factor("미터", "mm"), Ok(1000.0));
    }
}
