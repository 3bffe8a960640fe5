//! Which photos are the odd ones: those without which, each with an interior orientation of its own, the others agree.
//!
//! The fields of a photo's own interior orientation are linear. A photo that was cropped or scaled by hundreds of pixels bends its network so
//! far that what it leaves of higher order looks like interior orientations of other photos too. Therefore the network is adjusted again, with
//! the photo that explains most as a camera of its own, and examined again; further photos follow as long as the others do not agree, and
//! those go back that are not needed. Where a few photos are not enough, every photo is its own.

use super::{Looked, looked};
use crate::adjust::problem::left_out::RejectedObservations;
use crate::adjust::problem::numbering::Numbering;
use crate::adjust::solve::session::{Log, Session};
use crate::adjust::solve::values::applied;
use crate::adjustment::{AdjustOptions, PatternKind, StatisticsChoice, Termination};
use crate::project::{Camera, Project};

/// Maximum number of odd photos: with more, the zoom or focus of all photos has changed; each one costs an adjustment.
const MOST: usize = 4;

/// The odd photos, from the one that explains most (index into the network's photos); by their places in the document. `None` if a few
/// do not explain what is wrong, or if that cannot be determined.
pub fn odd(session: &Session<'_>, options: &AdjustOptions, suspect: usize) -> Option<Vec<usize>> {
    let first = session.network.photos[suspect].index;
    let camera = session.numbering.cameras[first];
    let count = session.network.photos.iter().filter(|p| session.numbering.cameras[p.index] == camera).count();
    if session.project.cameras[camera].per_photo || !session.weights.is_empty() {
        return None;
    }
    let mut odd = vec![first];
    loop {
        match left(session, options, camera, &odd)? {
            None => break,
            Some(next) => odd.push(next),
        }
        if odd.len() > MOST || odd.len() * 2 >= count {
            return None;
        }
    }
    for k in (0..odd.len()).rev() {
        let mut others = odd.clone();
        others.remove(k);
        if !others.is_empty() && left(session, options, camera, &others) == Some(None) {
            odd = others;
        }
    }
    odd.sort_unstable();
    Some(odd)
}

/// The photo of the camera that explains most of what is left where `odd` have cameras of their own; an inner none where the others agree.
/// `None` if it cannot be adjusted so.
fn left(session: &Session<'_>, options: &AdjustOptions, camera: usize, odd: &[usize]) -> Option<Option<usize>> {
    let document = apart(session, odd);
    let numbering = Numbering::of(&document);
    let left_out =
        RejectedObservations { given: session.network.left_out.clone(), ..RejectedObservations::nothing(&document) };
    let mut other = Session::new(&document, &numbering, &left_out).ok()?;
    let options = AdjustOptions {
        statistics: StatisticsChoice::Precision,
        covariance_of: Vec::new(),
        variance_components: None,
        ..options.clone()
    };
    let log = &mut Log { iterations: Vec::new(), on_iteration: &mut |_| true };
    if other.iterate(&options, log).ok()? != Termination::Converged {
        return None;
    }
    let cost = other.finish(&options, true).ok()?.cost;
    let Looked { rows, suspect } = looked(&mut other, options.residuals, cost)?;
    let id = &session.project.cameras[camera].id;
    let is_named = rows.iter().any(|row| row.named && row.kind == PatternKind::Photo && row.camera == *id);
    Some(suspect.filter(|_| is_named).map(|photo| other.network.photos[photo].index))
}

/// The document at the present values with what takes part in it, each of some photos with a camera of its own.
fn apart(session: &Session<'_>, odd: &[usize]) -> Project {
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
