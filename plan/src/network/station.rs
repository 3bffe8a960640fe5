//! Where a photo is taken from and where the camera points.

use crate::reason::PlanReason;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use sightline::error::{Error, Place, Result};
use sightline::initial::Pose;
use sightline::rotation;

/// A photo of a network: either its rotation is given, or the point it is aimed at with a roll.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Station {
    /// Identifier of the photo.
    pub id: String,
    /// Identifier of its camera.
    pub camera: String,
    /// Projection centre.
    pub position: [f64; 3],
    /// Omega, phi, kappa in radians.
    pub rotation: Option<[f64; 3]>,
    /// Point on the camera's axis, where no rotation is given.
    pub look_at: Option<[f64; 3]>,
    /// Roll of an aimed camera about its axis, radians; at 0 the object's Z axis points up in the photo (Y, when the
    /// camera looks along Z). The camera turns counterclockwise as seen from behind it.
    pub roll: f64,
}

impl Station {
    /// A station aimed at a point.
    pub fn aimed(id: impl Into<String>, camera: &str, position: [f64; 3], look_at: [f64; 3], roll: f64) -> Self {
        Self { id: id.into(), camera: camera.into(), position, rotation: None, look_at: Some(look_at), roll }
    }

    /// Exterior orientation.
    ///
    /// # Errors
    /// [`Error::Invalid`] if neither rotation nor aim is given, when the aim is the station itself, or when a number
    /// is not finite.
    pub fn pose(&self) -> Result<Pose> {
        let invalid =
            |reason, field: &str| Err(Error::Invalid { reason, at: Place::photo(&self.id).with_field(field) });
        let centre = Vector3::from(self.position);
        let finite = |numbers: &[f64]| numbers.iter().all(|n| n.is_finite());
        if !finite(&self.position) || !self.roll.is_finite() {
            return invalid(PlanReason::StationNotFinite.into(), "position");
        }
        if let Some(angles) = self.rotation {
            if !finite(&angles) {
                return invalid(PlanReason::StationAngles.into(), "rotation");
            }
            return Ok(Pose { object_to_camera: rotation::object_to_camera(angles), centre });
        }
        let Some(aim) = self.look_at else {
            return invalid(PlanReason::StationDirection.into(), "look_at");
        };
        let backwards = centre - Vector3::from(aim);
        if backwards.norm() == 0.0 || !finite(&aim) {
            return invalid(PlanReason::StationAim.into(), "look_at");
        }
        Ok(Pose { object_to_camera: aimed(&backwards.normalize(), self.roll), centre })
    }
}

/// Object to camera of a camera whose z axis is `z` (unit, away from the object).
fn aimed(z: &Vector3<f64>, roll: f64) -> Matrix3<f64> {
    let up = if z.x.hypot(z.y) > 1e-9 { Vector3::z() } else { Vector3::y() };
    let x = up.cross(z).normalize();
    let y = z.cross(&x);
    let upright = Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]);
    rotation::object_to_camera([0.0, 0.0, roll]) * upright
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn an_aimed_camera_sees_its_aim_in_the_middle_and_up_as_up() {
        let station = Station::aimed("1", "c", [100.0, -500.0, 80.0], [10.0, 20.0, 30.0], 0.0);
        let pose = station.pose().unwrap();
        let [x, y] = pose.image(&Vector3::new(10.0, 20.0, 30.0)).unwrap();
        assert!(x.abs() < 1e-12 && y.abs() < 1e-12);
        let [x, y] = pose.image(&Vector3::new(10.0, 20.0, 40.0)).unwrap();
        assert!(x.abs() < 1e-12 && y > 0.0);
        assert!((pose.object_to_camera.determinant() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn roll_turns_the_picture_the_other_way() {
        let rolled = Station::aimed("1", "c", [0.0, -500.0, 0.0], [0.0; 3], std::f64::consts::FRAC_PI_2);
        // Camera counterclockwise from behind: what was up appears at the right.
        let [x, y] = rolled.pose().unwrap().image(&Vector3::new(0.0, 0.0, 10.0)).unwrap();
        assert!(x > 0.0 && y.abs() < 1e-12, "{x} {y}");
    }

    #[test]
    fn a_camera_that_looks_down_is_possible() {
        let pose = Station::aimed("1", "c", [0.0, 0.0, 500.0], [0.0; 3], 0.0).pose().unwrap();
        assert!((pose.object_to_camera - Matrix3::identity()).norm() < 1e-12);
    }

    #[test]
    fn a_station_without_direction_is_refused() {
        let error = Station { id: "7".into(), ..Station::default() }.pose().expect_err("no direction");
        assert_eq!(error.place().photo.as_deref(), Some("7"));
        assert!(Station::aimed("1", "c", [1.0; 3], [1.0; 3], 0.0).pose().is_err());
    }
}
