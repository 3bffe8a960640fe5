//! A local Cartesian system on the ellipsoid: east, north, up at an origin.
//!
//! Latitude φ, longitude λ and ellipsoidal height h become geocentric coordinates,
//!
//! X = (N + h) cos φ cos λ, Y = (N + h) cos φ sin λ, Z = (N (1 − e²) + h) sin φ, N = a / √(1 − e² sin² φ), e² = f (2 − f),
//!
//! which are moved to the origin and turned so that the third axis is the normal of the ellipsoid there and the second one points to the
//! north. That is exact at any distance and has the scale 1; it is not a map projection, and at a distance d from the origin the third
//! coordinate is about d² / 2R below the height over the ellipsoid.
//!
//! Source: Hofmann-Wellenhof, Lichtenegger, Wasle, "GNSS", 2008, section 8.2; EPSG Guidance Note 7-2, methods 9602 and 9837.

use serde::{Deserialize, Serialize};

/// The ellipsoid. GRS80 has the same axes to 0.1 mm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ReferenceEllipsoid {
    /// WGS84: a = 6378137 m, 1/f = 298.257223563.
    #[default]
    #[serde(rename = "WGS84")]
    Wgs84,
}

impl ReferenceEllipsoid {
    /// Semi-major axis in metres and flattening.
    fn axis_and_flattening(self) -> (f64, f64) {
        match self {
            Self::Wgs84 => (6_378_137.0, 1.0 / 298.257_223_563),
        }
    }
}

/// A place on the ellipsoid: degrees and metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Geographic {
    /// To the north, degrees.
    pub latitude: f64,
    /// To the east, degrees.
    pub longitude: f64,
    /// Over the ellipsoid, metres.
    pub height: f64,
}

/// East, north and up at an origin, in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stated")]
pub struct LocalSystem {
    /// The ellipsoid.
    pub ellipsoid: ReferenceEllipsoid,
    /// Latitude of the origin, degrees.
    pub latitude: f64,
    /// Longitude of the origin, degrees.
    pub longitude: f64,
    /// Height of the origin over the ellipsoid, metres.
    pub height: f64,
}

/// Largest height of an origin, metres.
const HIGHEST: f64 = 1e6;

#[derive(Deserialize)]
struct Stated {
    #[serde(default)]
    ellipsoid: ReferenceEllipsoid,
    latitude: f64,
    longitude: f64,
    height: f64,
}

impl TryFrom<Stated> for LocalSystem {
    type Error = String;

    fn try_from(stated: Stated) -> Result<Self, String> {
        let Stated { ellipsoid, latitude, longitude, height } = stated;
        let within = |name: &str, value: f64, limit: f64| {
            (value.abs() <= limit).then_some(()).ok_or_else(|| format!("{name} is outside ±{limit}: {value}"))
        };
        within("latitude", latitude, 90.0)?;
        within("longitude", longitude, 180.0)?;
        within("height", height, HIGHEST)?;
        Ok(Self { ellipsoid, latitude, longitude, height })
    }
}

impl LocalSystem {
    /// The system at the mean of places, rounded to 0.0001° (11 m) and 1 m so that it can be stated and repeated; `None` without places.
    pub fn at_mean(places: &[Geographic]) -> Option<Self> {
        let first = places.first()?;
        let count = places.len() as f64;
        let mean = |of: &dyn Fn(&Geographic) -> f64| places.iter().map(of).sum::<f64>() / count;
        // On both sides of 180° the mean is at 180°, not at 0°.
        let east = mean(&|place| within_half_turn(place.longitude - first.longitude));
        let longitude = within_half_turn(rounded(within_half_turn(first.longitude + east)));
        let latitude = rounded(mean(&|place| place.latitude));
        let height = mean(&|place| place.height).round().clamp(-HIGHEST, HIGHEST) + 0.0;
        Some(Self { ellipsoid: ReferenceEllipsoid::Wgs84, latitude, longitude, height })
    }

    /// East, north and up of a place, metres.
    pub fn from_geographic(&self, place: Geographic) -> [f64; 3] {
        let origin = Geographic { latitude: self.latitude, longitude: self.longitude, height: self.height };
        let (here, there) = (self.geocentric(origin), self.geocentric(place));
        let [dx, dy, dz]: [f64; 3] = std::array::from_fn(|k| there[k] - here[k]);
        let (sin_lat, cos_lat) = self.latitude.to_radians().sin_cos();
        let (sin_lon, cos_lon) = self.longitude.to_radians().sin_cos();
        let outwards = cos_lon * dx + sin_lon * dy;
        [cos_lon * dy - sin_lon * dx, cos_lat * dz - sin_lat * outwards, cos_lat * outwards + sin_lat * dz]
    }

    /// Geocentric coordinates, metres.
    fn geocentric(&self, place: Geographic) -> [f64; 3] {
        let (a, f) = self.ellipsoid.axis_and_flattening();
        let e2 = f * (2.0 - f);
        let (sin_lat, cos_lat) = place.latitude.to_radians().sin_cos();
        let (sin_lon, cos_lon) = place.longitude.to_radians().sin_cos();
        let n = a / (1.0 - e2 * sin_lat * sin_lat).sqrt();
        let axial = (n + place.height) * cos_lat;
        [axial * cos_lon, axial * sin_lon, (n * (1.0 - e2) + place.height) * sin_lat]
    }
}

/// Degrees to four decimals.
fn rounded(degrees: f64) -> f64 {
    (degrees * 1e4).round() / 1e4 + 0.0
}

/// Degrees within ±180.
fn within_half_turn(degrees: f64) -> f64 {
    if degrees.abs() <= 180.0 { degrees } else { (degrees + 180.0).rem_euclid(360.0) - 180.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn place(latitude: f64, longitude: f64, height: f64) -> Geographic {
        Geographic { latitude, longitude, height }
    }

    fn system(latitude: f64, longitude: f64, height: f64) -> LocalSystem {
        LocalSystem { ellipsoid: ReferenceEllipsoid::Wgs84, latitude, longitude, height }
    }

    #[test]
    fn the_published_example_is_reproduced() {
        // EPSG Guidance Note 7-2, method 9602: 53°48'33.820"N, 2°07'46.380"E, 73.0 m, WGS84.
        let latitude = 53.0 + 48.0 / 60.0 + 33.82 / 3600.0;
        let longitude = 2.0 + 7.0 / 60.0 + 46.38 / 3600.0;
        let found = system(0.0, 0.0, 0.0).geocentric(place(latitude, longitude, 73.0));
        for (value, wanted) in found.into_iter().zip([3_771_793.968, 140_253.342, 5_124_304.349]) {
            assert!((value - wanted).abs() < 1e-3, "{found:?}");
        }
        // The same note, method 9837: origin 55°N 5°E 200 m; the point above.
        let local = system(55.0, 5.0, 200.0).from_geographic(place(latitude, longitude, 73.0));
        for (value, wanted) in local.into_iter().zip([-189_013.869, -128_642.040, -4_220.171]) {
            assert!((value - wanted).abs() < 1e-3, "{local:?}");
        }
    }

    #[test]
    fn axes_point_to_east_north_and_up() {
        // At the equator a degree is π/180 of the radius of curvature: a to the east, a (1 − e²) to the north.
        let here = system(0.0, 0.0, 0.0);
        let step = 1e-5;
        let [east, north] = [place(0.0, step, 0.0), place(step, 0.0, 0.0)].map(|to| here.from_geographic(to));
        assert!((east[0] - 6_378_137.0 * step.to_radians()).abs() < 1e-8 && east[1].abs() < 1e-8, "{east:?}");
        assert!((north[1] - 6_335_439.327 * step.to_radians()).abs() < 1e-8 && north[0].abs() < 1e-8, "{north:?}");
        let up = system(37.5, 127.0, 30.0).from_geographic(place(37.5, 127.0, 42.5));
        assert!(up[0].abs() < 1e-8 && up[1].abs() < 1e-8 && (up[2] - 12.5).abs() < 1e-8, "{up:?}");
    }

    #[test]
    fn the_origin_is_a_rounded_mean() {
        assert_eq!(LocalSystem::at_mean(&[]), None);
        let found = LocalSystem::at_mean(&[place(37.503_46, 127.001_2, 30.2), place(37.503_48, 127.001_4, 31.9)]);
        assert_eq!(found, Some(system(37.5035, 127.0013, 31.0)));
        let pacific = LocalSystem::at_mean(&[place(-17.0, 179.999, 0.0), place(-17.0, -179.997, 0.0)]);
        assert_eq!(pacific, Some(system(-17.0, -179.999, 0.0)));
    }

    #[test]
    fn an_origin_outside_the_ellipsoid_is_refused() {
        let read = |text: &str| serde_json::from_str::<LocalSystem>(text);
        let good = r#"{"ellipsoid":"WGS84","latitude":37.5,"longitude":127.0,"height":30.0}"#;
        let system = read(good).expect("a system");
        assert_eq!(serde_json::to_string(&system).expect("text"), good);
        for wrong in [
            r#"{"latitude":90.5,"longitude":127,"height":30}"#,
            r#"{"latitude":37,"longitude":181,"height":30}"#,
            r#"{"latitude":37,"longitude":127,"height":1e9}"#,
            r#"{"ellipsoid":"Bessel","latitude":37,"longitude":127,"height":3}"#,
        ] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
