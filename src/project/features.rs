//! Definitions of measurements on the result: geometric features of points, coordinate systems of the object, lines between
//! points in layers. They are not used in the adjustment; they are computed with each of its results ([`crate::features`]).

use serde::{Deserialize, Serialize};

use super::identifier::{identifier, identifiers};
use super::validation::{LARGEST, finite, invalid, known, unique};
use super::{Photo, Project, Role};
use crate::error::{Place, Reason, Result, Thing};

/// A named feature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Feature {
    /// Identifier, and its name for people.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// What it is.
    #[serde(flatten)]
    pub kind: FeatureKind,
}

/// Kind of a feature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum FeatureKind {
    /// Line of least squared distances from its points, two or more.
    Line {
        /// Its points.
        #[serde(deserialize_with = "identifiers")]
        points: Vec<String>,
    },
    /// Plane of least squared distances, from three points on.
    Plane {
        /// Its points.
        #[serde(deserialize_with = "identifiers")]
        points: Vec<String>,
    },
    /// Circle in space of least squared distances, from three points on.
    Circle {
        /// Its points.
        #[serde(deserialize_with = "identifiers")]
        points: Vec<String>,
    },
    /// Sphere of least squared distances, from four points on.
    Sphere {
        /// Its points.
        #[serde(deserialize_with = "identifiers")]
        points: Vec<String>,
    },
    /// Cylinder of least squared distances, from six points on.
    Cylinder {
        /// Its points.
        #[serde(deserialize_with = "identifiers")]
        points: Vec<String>,
    },
    /// Distance between two ends: of places (points, centres of circles and spheres), of a place from a line, an axis or a plane, of
    /// two lines, of a line from a plane, of two planes.
    Distance {
        /// One end: what lies at it is measured.
        from: End,
        /// The other.
        to: End,
    },
    /// Angle at a point between the directions to two others, or between two directions (of lines and axes, normals of planes and
    /// circles) as far as 90°.
    Angle {
        /// One side.
        from: End,
        /// The point it is measured at, where the sides are places.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at: Option<End>,
        /// The other side.
        to: End,
    },
    /// Deviations of points from a feature, positive outside of it or on the side of its normal; or from given coordinates of the
    /// same names, measured minus given.
    Deviations {
        /// The points; none: all that the feature does not have itself, or all that are given.
        #[serde(default, deserialize_with = "identifiers", skip_serializing_if = "Vec::is_empty")]
        points: Vec<String>,
        /// From which feature: a line, plane, circle, sphere or cylinder.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        feature: Option<String>,
        /// From which coordinates.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        given: Vec<GivenPoint>,
    },
}

/// An end of a distance or a side of an angle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// A point.
    Point(#[serde(deserialize_with = "identifier")] String),
    /// A feature that is fitted to points.
    Feature(#[serde(deserialize_with = "identifier")] String),
}

/// A point with coordinates of another system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GivenPoint {
    /// Identifier of the point.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// Its coordinates there.
    pub xyz: [f64; 3],
    /// Their standard errors, which are their weights; null: all alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma: Option<[f64; 3]>,
}

/// A named coordinate system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoordinateSystem {
    /// Identifier, and its name for people.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// How it is laid.
    #[serde(flatten)]
    pub kind: SystemKind,
}

/// How a coordinate system is laid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum SystemKind {
    /// In the object's plane: Z is its normal towards the photos, X its longer extent, the origin its centroid.
    Automatic {
        /// The points of the plane; none: all.
        #[serde(default, deserialize_with = "identifiers", skip_serializing_if = "Vec::is_empty")]
        points: Vec<String>,
    },
    /// Z is 0 in the plane of the first points, Y on the line of the second, X at the last.
    PlaneLinePoint {
        /// Three points or more; Z points to the side of the photos.
        #[serde(deserialize_with = "identifiers")]
        plane: Vec<String>,
        /// Two points or more, along X from the first to the last.
        #[serde(deserialize_with = "identifiers")]
        line: Vec<String>,
        /// The point where X is 0.
        #[serde(deserialize_with = "identifier")]
        point: String,
    },
    /// Of least weighted squared differences from given coordinates.
    BestFit {
        /// Given coordinates of three points or more.
        given: Vec<GivenPoint>,
        /// Whether the scale is fitted too; else lengths stay.
        #[serde(default)]
        scale: bool,
    },
}

/// A line between two points, for drawings.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DrawnLine {
    /// Identifier of one end.
    #[serde(deserialize_with = "identifier")]
    pub from: String,
    /// Identifier of the other end.
    #[serde(deserialize_with = "identifier")]
    pub to: String,
    /// Name of its layer; empty for the common one.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub layer: String,
}

/// A layer of drawn lines.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Layer {
    /// Its name.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// Red, green, blue.
    pub colour: [u8; 3],
}

impl FeatureKind {
    /// Points that the feature is fitted to, or whose deviations are wanted.
    pub fn points(&self) -> &[String] {
        match self {
            Self::Line { points }
            | Self::Plane { points }
            | Self::Circle { points }
            | Self::Sphere { points }
            | Self::Cylinder { points }
            | Self::Deviations { points, .. } => points,
            Self::Distance { .. } | Self::Angle { .. } => &[],
        }
    }

    /// Its word in the document.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Line { .. } => "line",
            Self::Plane { .. } => "plane",
            Self::Circle { .. } => "circle",
            Self::Sphere { .. } => "sphere",
            Self::Cylinder { .. } => "cylinder",
            Self::Distance { .. } => "distance",
            Self::Angle { .. } => "angle",
            Self::Deviations { .. } => "deviations",
        }
    }

    /// Every name of a point in it, to be changed.
    fn names_mut(&mut self) -> Vec<&mut String> {
        match self {
            Self::Line { points }
            | Self::Plane { points }
            | Self::Circle { points }
            | Self::Sphere { points }
            | Self::Cylinder { points } => points.iter_mut().collect(),
            Self::Distance { from, to } => [from, to].into_iter().filter_map(End::point_mut).collect(),
            Self::Angle { from, at, to } => {
                [Some(from), at.as_mut(), Some(to)].into_iter().flatten().filter_map(End::point_mut).collect()
            }
            Self::Deviations { points, given, .. } => {
                points.iter_mut().chain(given.iter_mut().map(|g| &mut g.id)).collect()
            }
        }
    }
}

impl End {
    fn point_mut(&mut self) -> Option<&mut String> {
        match self {
            Self::Point(id) => Some(id),
            Self::Feature(_) => None,
        }
    }
}

impl Project {
    /// Whether two documents differ in nothing but what is measured on the result, planned before it or written beside it.
    pub fn same_but_features(&self, other: &Self) -> bool {
        let Self {
            format,
            version,
            name,
            unit,
            axes: _,
            cameras,
            photos,
            points,
            observations,
            distances,
            datum,
            rig,
            set_aside,
            features: _,
            systems: _,
            lines: _,
            layers: _,
            report: _,
            plan: _,
            epoch: _,
            origin: _,
        } = self;
        (format, version, name, unit) == (&other.format, &other.version, &other.name, &other.unit)
            && (cameras, points) == (&other.cameras, &other.points)
            && photos.len() == other.photos.len()
            && photos.iter().zip(&other.photos).all(|(a, b)| same_photo(a, b))
            && (observations, distances, datum) == (&other.observations, &other.distances, &other.datum)
            && (rig, set_aside) == (&other.rig, &other.set_aside)
    }

    /// Another name of a point in features, systems and lines.
    pub fn rename_in_features(&mut self, from: &str, to: &str) {
        let features = self.features.iter_mut().flat_map(|f| f.kind.names_mut());
        let systems = self.systems.iter_mut().flat_map(|s| match &mut s.kind {
            SystemKind::Automatic { points } => points.iter_mut().collect::<Vec<_>>(),
            SystemKind::PlaneLinePoint { plane, line, point } => plane.iter_mut().chain(line).chain([point]).collect(),
            SystemKind::BestFit { given, .. } => given.iter_mut().map(|g| &mut g.id).collect(),
        });
        let lines = self.lines.iter_mut().flat_map(|l| [&mut l.from, &mut l.to]);
        features.chain(systems).chain(lines).filter(|name| name.as_str() == from).for_each(|name| to.clone_into(name));
    }

    /// Points with given coordinates, by name.
    pub fn given_points(&self) -> impl Iterator<Item = GivenPoint> + '_ {
        self.points
            .iter()
            .filter(|p| p.role != Role::Tie)
            .filter_map(|p| Some(GivenPoint { id: p.id.clone(), xyz: p.xyz?, sigma: None }))
    }

    /// Names are unique and numbers are numbers; a point that is not there any more is reported in the result.
    pub(super) fn validate_features(&self) -> Result<()> {
        let at = |id: &str| Place::field(format!("features: {id}"));
        let names = unique(Thing::Feature, self.features.iter().map(|f| f.id.as_str()), at)?;
        for feature in &self.features {
            let here = || at(&feature.id);
            let ends: Vec<&End> = match &feature.kind {
                FeatureKind::Distance { from, to } => vec![from, to],
                FeatureKind::Angle { from, at, to } => vec![from, to].into_iter().chain(at).collect(),
                FeatureKind::Deviations { feature: of, given, .. } => {
                    if let Some(of) = of {
                        known(Thing::Feature, of, &names, here)?;
                    }
                    given_points(given, here)?;
                    Vec::new()
                }
                _ => Vec::new(),
            };
            for end in ends {
                if let End::Feature(id) = end {
                    known(Thing::Feature, id, &names, here)?;
                }
            }
        }
        let at = |id: &str| Place::field(format!("systems: {id}"));
        unique(Thing::System, self.systems.iter().map(|s| s.id.as_str()), at)?;
        for system in &self.systems {
            if let SystemKind::BestFit { given, .. } = &system.kind {
                given_points(given, || at(&system.id))?;
            }
        }
        unique(Thing::Layer, self.layers.iter().map(|l| l.id.as_str()), |id| Place::field(format!("layers: {id}")))?;
        if let Some(line) = self.lines.iter().find(|l| l.from == l.to) {
            return invalid(Reason::DistanceEnds, Place::point(&line.from).with_field("lines"));
        }
        Ok(())
    }
}

/// Whether two photos differ in nothing but what is known of their files' contents, which the adjustment does not see.
fn same_photo(photo: &Photo, other: &Photo) -> bool {
    let Photo { id, camera, file, position, rotation, sigma_position, interior, enabled, sha256: _ } = photo;
    (id, camera, file, enabled) == (&other.id, &other.camera, &other.file, &other.enabled)
        && (position, rotation) == (&other.position, &other.rotation)
        && (sigma_position, interior) == (&other.sigma_position, &other.interior)
}

fn given_points(given: &[GivenPoint], at: impl Fn() -> Place + Copy) -> Result<()> {
    unique(Thing::Point, given.iter().map(|g| g.id.as_str()), |_| at())?;
    for point in given {
        let here = || Place { point: Some(point.id.clone()), ..at() };
        finite(point.xyz.iter(), here)?;
        if point.sigma.iter().flatten().any(|s| !(*s > 0.0 && *s < LARGEST)) {
            return invalid(Reason::GivenSigma, here());
        }
    }
    Ok(())
}
