//! Writes the adjusted values of a session back into its document.

use crate::adjust::solve::session::Session;
use crate::project::{Project, Role};
use crate::rotation;

/// The session's document with its present values as initial values; observed camera parameters stay as given.
pub fn applied(session: &Session<'_>) -> Project {
    let (network, state) = (&session.network, &session.state);
    let mut project = session.project.clone();
    for (block, pose) in network.photos.iter().zip(&state.poses) {
        let photo = &mut project.photos[block.index];
        photo.position = Some(network.frame.outside(pose.centre));
        photo.rotation = Some(rotation::angles(&pose.matrix()));
    }
    for (block, interior) in network.interiors.iter().zip(&state.interiors) {
        let camera = &mut project.cameras[block.camera];
        let mut interior = *interior;
        for parameter in camera.sigma.keys() {
            if let Some(given) = camera.interior.get(*parameter) {
                interior.set(*parameter, given);
            }
        }
        match block.photo {
            None => camera.interior = interior,
            Some(k) => project.photos[network.photos[k].index].interior = Some(interior),
        }
    }
    for (block, xyz) in network.points.iter().zip(&state.points) {
        let point = &mut project.points[block.index];
        if point.role == Role::Tie {
            point.xyz = Some(network.frame.outside(*xyz));
        }
    }
    project
}
