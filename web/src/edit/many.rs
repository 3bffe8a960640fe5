//! Edits of many rows at once: excluding, deleting, roles, names by a pattern or by the nearest given coordinates, merging
//! and splitting points and cameras.

use std::collections::{BTreeMap, BTreeSet};

use sightline::project::{Project, Role};

use super::{cameras, natural, points};
use crate::document::Document;
use crate::document::Table;
use crate::document::keys::observation_of_key;

/// Keys of rows.
pub type RowKeys = BTreeSet<String>;

/// Lets rows take part or not: photos, observations, points with all that was measured of them. How many changed.
pub fn switch(project: &mut Project, table: Table, keys: &RowKeys, enabled: bool) -> usize {
    let mut changed = 0;
    let mut set = |flag: &mut bool| {
        changed += usize::from(*flag != enabled);
        *flag = enabled;
    };
    match table {
        Table::Photos => project.photos.iter_mut().filter(|p| keys.contains(&p.id)).for_each(|p| set(&mut p.enabled)),
        Table::Observations => {
            let pairs = keys.iter().filter_map(|key| observation_of_key(key)).collect::<BTreeSet<_>>();
            let mine = |o: &&mut sightline::project::Observation| pairs.contains(&(o.photo.as_str(), o.point.as_str()));
            project.observations.iter_mut().filter(mine).for_each(|o| set(&mut o.enabled));
        }
        Table::Points | Table::Control => {
            project.observations.iter_mut().filter(|o| keys.contains(&o.point)).for_each(|o| set(&mut o.enabled));
        }
        Table::Cameras | Table::Distances | Table::Identities => {}
    }
    changed
}

/// Takes rows out of the document; of targets their names. How many. Cameras go where no photo is of them.
pub fn delete(document: &mut Document, table: Table, keys: &RowKeys) -> usize {
    let before = count(document, table);
    match table {
        Table::Photos => {
            let photos =
                document.project.photos.iter().filter(|p| keys.contains(&p.id)).map(|p| p.id.clone()).collect();
            cameras::remove_photos(document, &photos);
        }
        Table::Cameras => {
            let used = document.project.photos.iter().map(|p| p.camera.clone()).collect::<RowKeys>();
            document.project_mut().cameras.retain(|c| used.contains(&c.id) || !keys.contains(&c.id));
        }
        Table::Points | Table::Control => {
            let project = document.project_mut();
            project.observations.retain(|o| !keys.contains(&o.point));
            project.distances.retain(|d| !keys.contains(&d.from) && !keys.contains(&d.to));
            if let Some(points) = &mut project.datum.points {
                points.retain(|point| !keys.contains(point));
            }
            project.lines.retain(|line| !keys.contains(&line.from) && !keys.contains(&line.to));
            project.points.retain(|p| !keys.contains(&p.id));
        }
        Table::Observations | Table::Identities => {
            let pairs = keys.iter().filter_map(|key| observation_of_key(key)).collect::<BTreeSet<_>>();
            let project = document.project_mut();
            project.observations.retain(|o| match table {
                Table::Observations => !pairs.contains(&(o.photo.as_str(), o.point.as_str())),
                _ => !o.target.is_some_and(|id| pairs.contains(&(o.photo.as_str(), id.to_string().as_str()))),
            });
            points::tidy(project);
        }
        Table::Distances => {
            let mut at = 0;
            document.project_mut().distances.retain(|_| {
                at += 1;
                !keys.contains(&(at - 1).to_string())
            });
        }
    }
    before - count(document, table)
}

fn count(document: &Document, table: Table) -> usize {
    let project = &document.project;
    match table {
        Table::Photos => project.photos.len(),
        Table::Cameras => project.cameras.len(),
        Table::Points | Table::Control => project.points.len(),
        Table::Observations => project.observations.len(),
        Table::Identities => project.observations.iter().filter(|o| o.target.is_some()).count(),
        Table::Distances => project.distances.len(),
    }
}

/// Gives points a role. How many have another one now.
pub fn set_roles(project: &mut Project, ids: &RowKeys, role: Role) -> usize {
    let mut changed = 0;
    for point in project.points.iter_mut().filter(|p| ids.contains(&p.id) && p.role != role) {
        point.role = role;
        changed += 1;
    }
    changed
}

/// Makes points one: it has the name of the one that is known, else of the first.
///
/// # Errors
/// The photo that shows two of them; nothing has changed then.
pub fn merge(project: &mut Project, ids: &RowKeys) -> Result<String, String> {
    let mut there = project.points.iter().filter(|p| ids.contains(&p.id)).collect::<Vec<_>>();
    there.sort_by(|a, b| (a.role == Role::Tie).cmp(&(b.role == Role::Tie)).then_with(|| natural(&a.id, &b.id)));
    let names = there.into_iter().map(|p| p.id.clone()).collect::<Vec<_>>();
    let mut seen = BTreeMap::new();
    for o in project.observations.iter().filter(|o| ids.contains(&o.point)) {
        if seen.insert(o.photo.as_str(), &o.point).is_some() {
            return Err(o.photo.clone());
        }
    }
    let Some((kept, others)) = names.split_first() else { return Ok(String::new()) };
    for other in others {
        points::rename(project, other, kept)?;
    }
    Ok(kept.clone())
}

/// Parts a point: what these photos show becomes a point of its own. Its name; `None` if nothing or everything would go.
pub fn split(project: &mut Project, id: &str, photos: &RowKeys) -> Option<String> {
    let (going, staying): (Vec<_>, Vec<_>) =
        project.observations.iter().filter(|o| o.point == id).partition(|o| photos.contains(&o.photo));
    if going.is_empty() || staying.is_empty() {
        return None;
    }
    let name = points::next_free(project, &format!("{id}-1"));
    for o in project.observations.iter_mut().filter(|o| o.point == id && photos.contains(&o.photo)) {
        o.point.clone_from(&name);
    }
    points::tidy(project);
    Some(name)
}

/// Why points keep their names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RenameFault {
    /// Two would have this name.
    Twice(String),
    /// A point that is not among them has it.
    Taken(String),
    /// The pattern gives an empty name.
    Empty,
}

/// New names by a pattern: a row of '#' is the counter, as many digits; '*' is the old name. Points count in their order.
pub fn by_pattern(ids: &[String], pattern: &str, start: u64) -> BTreeMap<String, String> {
    let digits = pattern.chars().filter(|c| *c == '#').count();
    let hashes = "#".repeat(digits);
    let name = |k: usize, id: &String| {
        let number = format!("{:0digits$}", start + k as u64);
        let counted = if digits > 0 { pattern.replacen(&hashes, &number, 1) } else { pattern.to_owned() };
        (id.clone(), counted.replace('*', id).trim().to_owned())
    };
    ids.iter().enumerate().map(|(k, id)| name(k, id)).collect()
}

/// New names by the nearest given coordinates, each given name once, the nearest pairs first, none farther than `tolerance`.
pub fn by_nearest(
    points: &[(String, [f64; 3])],
    given: &[(String, [f64; 3])],
    tolerance: f64,
) -> BTreeMap<String, String> {
    let distance = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    let mut pairs = Vec::new();
    for (i, (_, a)) in points.iter().enumerate() {
        for (j, (_, b)) in given.iter().enumerate() {
            let apart = distance(a, b);
            if apart <= tolerance {
                pairs.push((apart, i, j));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut used, mut names) = (BTreeSet::new(), BTreeMap::new());
    for (_, i, j) in pairs {
        if !names.contains_key(&points[i].0) && used.insert(j) {
            names.insert(points[i].0.clone(), given[j].0.clone());
        }
    }
    names
}

/// Gives points new names, all at once, so that names may be exchanged. How many have another one now.
///
/// # Errors
/// Which name two would have, or another point has; nothing has changed then.
pub fn rename_all(project: &mut Project, names: &BTreeMap<String, String>) -> Result<usize, RenameFault> {
    let mut new = BTreeSet::new();
    for (from, to) in names {
        if to.is_empty() {
            return Err(RenameFault::Empty);
        }
        if !new.insert(to) {
            return Err(RenameFault::Twice(to.clone()));
        }
        if from != to && !names.contains_key(to) && project.points.iter().any(|p| p.id == *to) {
            return Err(RenameFault::Taken(to.clone()));
        }
    }
    let rename = |id: &mut String| {
        if let Some(to) = names.get(id) {
            id.clone_from(to);
        }
    };
    project.points.iter_mut().for_each(|p| rename(&mut p.id));
    project.observations.iter_mut().for_each(|o| rename(&mut o.point));
    project.set_aside.iter_mut().for_each(|o| rename(&mut o.point));
    project.distances.iter_mut().for_each(|d| {
        rename(&mut d.from);
        rename(&mut d.to);
    });
    project.datum.points.iter_mut().flatten().for_each(rename);
    // Names that are exchanged pass through ones that nothing has.
    for (k, from) in names.keys().enumerate() {
        project.rename_in_features(from, &format!("\u{1f}{k}"));
    }
    for (k, to) in names.values().enumerate() {
        project.rename_in_features(&format!("\u{1f}{k}"), to);
    }
    Ok(names.iter().filter(|(from, to)| from != to).count())
}

/// Makes cameras one: their photos are of the first. Its name; none below two cameras or where their grids differ.
pub fn join_cameras(project: &mut Project, ids: &RowKeys) -> Option<String> {
    let cameras = project.cameras.iter().filter(|c| ids.contains(&c.id)).collect::<Vec<_>>();
    let (first, others) = cameras.split_first()?;
    if others.is_empty() || others.iter().any(|c| (c.width, c.height) != (first.width, first.height)) {
        return None;
    }
    let kept = first.id.clone();
    for photo in project.photos.iter_mut().filter(|p| ids.contains(&p.camera)) {
        photo.camera.clone_from(&kept);
    }
    project.cameras.retain(|c| c.id == kept || !ids.contains(&c.id));
    Some(kept)
}

#[cfg(test)]
mod tests {
    use sightline::project::{Camera, Distance, Interior, Observation, Photo, Sigma};

    use super::*;
    use crate::document::keys::observation_key;

    fn seen(photo: &str, point: &str) -> Observation {
        Observation {
            photo: photo.into(),
            point: point.into(),
            u: 1.0,
            v: 1.0,
            sigma: Sigma::One(0.1),
            enabled: true,
            target: Some(3),
        }
    }

    fn project() -> Project {
        let mut project = Project {
            observations: vec![seen("1", "a"), seen("2", "a"), seen("3", "b"), seen("1", "c")].into(),
            distances: vec![Distance { from: "a".into(), to: "c".into(), length: 1.0, sigma: 0.1, check: false }],
            ..Project::default()
        };
        points::tidy(&mut project);
        project
    }

    fn keys(all: &[&str]) -> RowKeys {
        all.iter().map(|key| (*key).to_owned()).collect()
    }

    fn of(project: &Project, point: &str) -> usize {
        project.observations.iter().filter(|o| o.point == point).count()
    }

    #[test]
    fn rows_are_excluded_and_restored() {
        let mut p = project();
        assert_eq!(switch(&mut p, Table::Points, &keys(&["a", "b"]), false), 3);
        assert_eq!(switch(&mut p, Table::Observations, &[observation_key("2", "a")].into(), true), 1);
        assert_eq!(p.observations.iter().map(|o| o.enabled).collect::<Vec<_>>(), [false, true, false, true]);
        assert_eq!(switch(&mut p, Table::Distances, &keys(&["0"]), false), 0);
    }

    #[test]
    fn rows_are_deleted_with_what_hangs_on_them() {
        let document = |p: Project| Document { project: std::sync::Arc::new(p), ..Document::default() };
        let mut d = document(project());
        assert_eq!(delete(&mut d, Table::Points, &keys(&["a"])), 1);
        assert!(d.project.distances.is_empty() && of(&d.project, "a") == 0);
        let mut d = document(project());
        assert_eq!(delete(&mut d, Table::Observations, &[observation_key("3", "b")].into()), 1);
        assert!(!d.project.points.iter().any(|p| p.id == "b"));
        assert_eq!(delete(&mut d, Table::Identities, &[observation_key("1", "3")].into()), 2);
        assert_eq!(delete(&mut d, Table::Distances, &keys(&["0", "7"])), 1);
        let mut p = project();
        p.cameras = ["x", "y"].map(|id| Camera::new(id, 10, 10, Interior::brown(1.0))).into();
        p.photos = vec![Photo { id: "1".into(), camera: "x".into(), ..Photo::default() }].into();
        let mut d = document(p);
        assert_eq!(delete(&mut d, Table::Cameras, &keys(&["x", "y"])), 1);
        assert_eq!(delete(&mut d, Table::Photos, &keys(&["1"])), 1);
    }

    #[test]
    fn points_become_one_unless_a_photo_shows_two_and_are_parted_again() {
        let mut p = project();
        assert_eq!(merge(&mut p, &keys(&["a", "c"])), Err("1".into()));
        assert_eq!(p, project());
        assert_eq!(set_roles(&mut p, &keys(&["b", "c"]), Role::Check), 2);
        assert_eq!(merge(&mut p, &keys(&["a", "b"])), Ok("b".into()));
        assert_eq!((of(&p, "b"), of(&p, "a")), (3, 0));
        assert_eq!(split(&mut p, "b", &keys(&["1", "2"])).as_deref(), Some("b-1"));
        assert_eq!((of(&p, "b"), of(&p, "b-1")), (1, 2));
        assert_eq!((split(&mut p, "b", &keys(&["3"])), split(&mut p, "b", &keys(&["9"]))), (None, None));
    }

    #[test]
    fn names_follow_a_pattern_or_the_nearest_given_point_and_may_be_exchanged() {
        let ids = ["a", "c"].map(str::to_owned);
        let names = by_pattern(&ids, "P##", 9);
        assert_eq!(names.values().collect::<Vec<_>>(), ["P09", "P10"]);
        assert_eq!(by_pattern(&ids, "*x", 1)["c"], "cx");
        let mut p = project();
        assert_eq!(rename_all(&mut p, &names), Ok(2));
        assert_eq!((of(&p, "P09"), p.distances[0].to.as_str()), (2, "P10"));
        let swap = [("P09", "P10"), ("P10", "P09")].map(|(a, b)| (a.to_owned(), b.to_owned())).into();
        assert_eq!(rename_all(&mut p, &swap), Ok(2));
        assert_eq!((of(&p, "P10"), of(&p, "P09")), (2, 1));
        let before = p.clone();
        let one = |from: &str, to: &str| [(from.to_owned(), to.to_owned())].into();
        assert_eq!(rename_all(&mut p, &one("b", "P09")), Err(RenameFault::Taken("P09".into())));
        assert_eq!(rename_all(&mut p, &by_pattern(&ids, "x", 1)), Err(RenameFault::Twice("x".into())));
        assert_eq!(rename_all(&mut p, &one("b", "")), Err(RenameFault::Empty));
        assert_eq!(p, before);
        let at = |id: &str, x: f64| (id.to_owned(), [x, 0.0, 0.0]);
        let names = by_nearest(&[at("u1", 0.0), at("u2", 1.0), at("u3", 9.0)], &[at("A", 0.4), at("B", 1.1)], 0.5);
        assert_eq!(
            names.into_iter().collect::<Vec<_>>(),
            [("u1", "A"), ("u2", "B")].map(|(a, b)| (a.into(), b.into()))
        );
    }

    #[test]
    fn cameras_of_one_grid_become_one() {
        let mut p = project();
        p.cameras =
            [("x", 10), ("y", 10), ("z", 20)].map(|(id, w)| Camera::new(id, w, 10, Interior::brown(1.0))).into();
        p.photos = vec![Photo { id: "1".into(), camera: "y".into(), ..Photo::default() }].into();
        assert_eq!(join_cameras(&mut p, &keys(&["x", "z"])), None);
        assert_eq!(join_cameras(&mut p, &keys(&["x", "y"])).as_deref(), Some("x"));
        assert_eq!((p.cameras.len(), p.photos[0].camera.as_str()), (2, "x"));
        assert_eq!(join_cameras(&mut p, &keys(&["x"])), None);
    }
}
