//! Which photos are the odd ones: those without which, each with an interior orientation of its own, the others agree.
//!
//! The fields of a photo's own interior orientation are linear. A photo that was cropped or scaled by hundreds of pixels bends its network so
//! far that what it leaves of higher order looks like interior orientations of other photos too. Therefore the network is adjusted again, with
//! the photo that explains most as a camera of its own, and examined again; further photos follow as long as the others do not agree, and
//! those go back that are not needed. Where a few photos are not enough, every photo is its own.

use std::collections::HashMap;

use super::{Looked, looked};
use crate::adjust::problem::left_out::{Key, RejectedObservations};
use crate::adjust::problem::numbering::Numbering;
use crate::adjust::solve::session::{Log, Session};
use crate::adjust::solve::values::applied;
use crate::adjustment::{AdjustOptions, PatternKind, StatisticsChoice, Termination};
use crate::project::{Camera, Datum, DatumKind, Observation, Project, Role};

/// Maximum number of odd photos: with more, the zoom or focus of all photos has changed; each one costs an adjustment.
const MOST: usize = 4;
/// Steps for the odd photos on given points, where one costs a fraction of one of the network.
const ALONE: usize = 500;

/// The odd photos, from the one that explains most (index into the network's photos); by their places in the document. `None` if a few
/// do not explain what is wrong, or if that cannot be determined.
pub fn odd(session: &Session<'_>, options: &AdjustOptions, suspect: usize) -> Option<Odd> {
    let first = session.network.photos[suspect].index;
    let camera = session.numbering.cameras[first];
    let count = session.network.photos.iter().filter(|p| session.numbering.cameras[p.index] == camera).count();
    if session.project.cameras[camera].per_photo || !session.weights.is_empty() {
        return None;
    }
    let mut odd = vec![first];
    let mut left = apart(session, options, camera, &odd)?;
    while let Some(next) = left.next {
        odd.push(next);
        if odd.len() > MOST || odd.len() * 2 >= count {
            return None;
        }
        left = apart(session, options, camera, &odd)?;
    }
    for k in (0..odd.len()).rev() {
        let mut others = odd.clone();
        others.remove(k);
        if others.is_empty() {
            break;
        }
        if let Some(found) = apart(session, options, camera, &others).filter(|found| found.next.is_none()) {
            (odd, left) = (others, found);
        }
    }
    odd.sort_unstable();
    Some(Odd { photos: odd, cost: left.cost, unknowns: session.redundancy.saturating_sub(left.redundancy) })
}

/// Photos without which the others agree.
pub struct Odd {
    /// By their places in the document.
    pub photos: Vec<usize>,
    /// vᵀPv with cameras of their own.
    pub cost: f64,
    /// Unknowns that these cameras add.
    pub unknowns: usize,
}

/// A network adjusted with some photos as cameras of their own.
struct ApartAdjusted {
    /// vᵀPv.
    cost: f64,
    redundancy: usize,
    /// The photo of the common camera that explains most of what is left; none where the others agree.
    next: Option<usize>,
}

/// Adjusts with each of the photos `odd` as a camera of its own. `None` if it cannot be adjusted so.
fn apart(session: &Session<'_>, options: &AdjustOptions, camera: usize, odd: &[usize]) -> Option<ApartAdjusted> {
    let options = AdjustOptions {
        statistics: StatisticsChoice::Precision,
        covariance_of: Vec::new(),
        variance_components: None,
        ..options.clone()
    };
    let given = &session.network.left_out;
    let document = document(session, odd);
    let id = &session.project.cameras[camera].id;
    left(&document, given, id, &options)
        .or_else(|| left(&unbent(&document, given, odd, &options)?, given, id, &options))
}

/// As [`apart`], of the document with these cameras; `None` if it does not converge.
fn left(document: &Project, given: &[Key], camera: &str, options: &AdjustOptions) -> Option<ApartAdjusted> {
    let numbering = Numbering::of(document);
    let left_out = RejectedObservations { given: given.to_vec(), ..RejectedObservations::nothing(document) };
    let mut session = Session::new(document, &numbering, &left_out).ok()?;
    if iterated(&mut session, options)? != Termination::Converged {
        return None;
    }
    let cost = session.finish(options, true).ok()?.cost;
    let Looked { rows, suspect } = looked(&mut session, options.residuals, cost)?;
    let is_named = rows.iter().any(|row| row.named && row.kind == PatternKind::Photo && row.camera == camera);
    let next = suspect.filter(|_| is_named).map(|photo| session.network.photos[photo].index);
    Some(ApartAdjusted { cost, redundancy: session.redundancy, next })
}

fn iterated(session: &mut Session<'_>, options: &AdjustOptions) -> Option<Termination> {
    let log = &mut Log { iterations: Vec::new(), on_iteration: &mut |_| true };
    session.iterate(options, log).ok()
}

/// The document from better initial values. A photo scaled by a third has bent the network and its own pose so far that the joint adjustment
/// would take hundreds of steps along a narrow valley of principal distance, distortion and pose. So the others are adjusted without the
/// photos `odd`, then these on the points that result. `None` where the others determine too little.
fn unbent(document: &Project, given: &[Key], odd: &[usize], options: &AdjustOptions) -> Option<Project> {
    let is_odd: Vec<bool> = Numbering::of(document).observations.iter().map(|(photo, _)| odd.contains(photo)).collect();
    let mut rays: HashMap<&str, usize> = HashMap::new();
    for (o, _) in document.observations.iter().zip(&is_odd).filter(|(o, odd)| o.enabled && !**odd) {
        *rays.entry(o.point.as_str()).or_default() += 1;
    }
    // of a point that is seen once without them nothing is known
    let determined = |o: &Observation| rays.get(o.point.as_str()).is_some_and(|rays| *rays > 1);
    let settle = |document: &Project, given: &[Key], options: &AdjustOptions| {
        let numbering = Numbering::of(document);
        let left_out = RejectedObservations { given: given.to_vec(), ..RejectedObservations::nothing(document) };
        let mut session = Session::new(document, &numbering, &left_out).ok()?;
        let termination = iterated(&mut session, options)?;
        Some((applied(&session), termination))
    };
    let mut others = document.clone();
    for (o, odd) in others.observations.iter_mut().zip(&is_odd) {
        o.enabled &= !odd && determined(o);
    }
    let (others, termination) = settle(&others, given, options)?;
    if termination != Termination::Converged {
        return None;
    }
    let mut alone = others.clone();
    alone.datum = Datum { kind: DatumKind::Control, points: None };
    alone.distances.clear();
    for point in alone.points.iter_mut() {
        (point.role, point.sigma) = (Role::Control, None);
    }
    for ((o, odd), before) in alone.observations.iter_mut().zip(&is_odd).zip(document.observations.iter()) {
        o.enabled = before.enabled && *odd && determined(before);
    }
    let options = AdjustOptions { max_iterations: ALONE, ..options.clone() };
    let (mut alone, _) = settle(&alone, &[], &options)?;
    // what is given stays given
    (alone.datum, alone.distances, alone.points) = (document.datum.clone(), document.distances.clone(), others.points);
    for (o, before) in alone.observations.iter_mut().zip(document.observations.iter()) {
        o.enabled = before.enabled;
    }
    Some(alone)
}

/// The document at the present values with what takes part in it, each of some photos with a camera of its own.
fn document(session: &Session<'_>, odd: &[usize]) -> Project {
    let mut document = applied(session);
    let mut takes_part = vec![false; document.observations.len()];
    session.network.rays.iter().for_each(|ray| takes_part[ray.row] = true);
    document.observations.iter_mut().zip(takes_part).for_each(|(o, part)| o.enabled &= part);
    // A rig's columns are of one camera each.
    document.rig = None;
    for &photo in odd {
        let mut id = format!("{} {photo}", document.photos[photo].camera);
        while document.cameras.iter().any(|camera| camera.id == id) {
            id.push('\'');
        }
        let own = Camera { id: id.clone(), ..document.cameras[session.numbering.cameras[photo]].clone() };
        document.cameras.push(own);
        document.photos[photo].camera = id;
    }
    document
}
