//! What the 3-D view shows of a result, and how: the scene, its layers, the exaggerations.

use std::sync::Arc;

use leptos::prelude::*;

use super::Chosen;
use super::scene::{factors, scene};
use crate::browser::object::{Scene, SceneState, numbered};
use crate::store::Desk;

/// Steps of the exaggerations: 1, 2, 5, 10 … a million.
pub const STEPS: i32 = 18;

pub fn exaggeration(step: i32) -> f64 {
    [1.0, 2.0, 5.0][step.rem_euclid(3) as usize] * 10f64.powi(step.div_euclid(3))
}

fn step_of(factor: f64) -> i32 {
    let distance = |step: &i32| (exaggeration(*step).ln() - factor.max(1e-9).ln()).abs();
    (0..=STEPS).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

/// The scene, the exaggerations that suit it, and the feature whose deviations it has. Scenes are compared by their addresses: any
/// change of one makes a new one.
#[derive(Clone)]
pub struct ShownScene {
    pub scene: Arc<Scene>,
    /// Of ellipsoids and of deviations.
    factors: (f64, f64),
    feature: Option<String>,
}

impl PartialEq for ShownScene {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
    }
}

/// The scene of the present result.
pub fn shown_scene(desk: Desk, chosen: Chosen) -> Memo<ShownScene> {
    Memo::new(move |_| {
        let feature = chosen.features.with(|all| all.last().cloned());
        let (scene, factors) = desk.document.with(|d| {
            let Some(result) = d.current() else { return (Scene::default(), (1.0, 1.0)) };
            let scene = scene(result, &d.project, feature.as_deref());
            let factors = factors(result, &scene);
            (scene, factors)
        });
        ShownScene { scene: Arc::new(scene), factors, feature }
    })
}

/// Layers, projection and exaggerations.
#[derive(Clone, Copy)]
pub struct Display {
    /// Layers by the view's own names, and whether they are shown.
    pub layers: RwSignal<Vec<(&'static str, bool)>>,
    pub perspective: RwSignal<bool>,
    /// Steps of the exaggeration of ellipsoids, and of deviations.
    pub ellipsoids: RwSignal<i32>,
    pub deviations: RwSignal<i32>,
}

impl Display {
    pub fn new(layers: impl IntoIterator<Item = &'static str>) -> Self {
        Self {
            layers: RwSignal::new(layers.into_iter().map(|name| (name, true)).collect()),
            perspective: RwSignal::new(true),
            ellipsoids: RwSignal::new(0),
            deviations: RwSignal::new(0),
        }
    }

    /// Sets the exaggerations of another object or feature; while these stay the same, the user's settings stay.
    pub fn suit(self, shown: Memo<ShownScene>) {
        let suited = StoredValue::new((String::new(), None::<String>, false));
        Effect::new(move |_| {
            let ShownScene { scene, factors: (ellipsoids, deviations), feature } = shown.get();
            // A new feature has its deviations once it is measured: only then they have a size.
            let now = (scene.key.clone(), feature, !scene.sticks.is_empty());
            let before = suited.get_value();
            if before.0 != now.0 {
                self.ellipsoids.set(step_of(ellipsoids));
            }
            if before != now {
                self.deviations.set(step_of(deviations));
            }
            suited.set_value(now);
        });
    }

    pub fn is_shown(self, layer: &str) -> bool {
        self.layers.with(|all| all.iter().any(|(name, on)| *name == layer && *on))
    }

    pub fn switch(self, layer: &str) {
        self.layers.update(|all| all.iter_mut().filter(|(name, _)| *name == layer).for_each(|(_, on)| *on = !*on));
    }

    /// Data sent to the view, with the selection of the desk.
    pub fn state(self, desk: Desk, chosen: Chosen, shown: Memo<ShownScene>) -> Memo<SceneState> {
        Memo::new(move |_| {
            let (selected, photo, several) = shown.with(|ShownScene { scene, .. }| {
                let points = numbered(&scene.names);
                let photos = numbered(&scene.photo_names);
                let (point, photo) = desk.selection.with(|s| (s.point.clone(), s.photo.clone()));
                let several =
                    chosen.points.with(|all| all.iter().filter_map(|id| points.get(id.as_str()).copied()).collect());
                (
                    point.and_then(|id| points.get(id.as_str()).copied()),
                    photo.and_then(|id| photos.get(id.as_str()).copied()),
                    several,
                )
            });
            let along = chosen.features.with(|all| {
                let id = all.last()?;
                desk.document.with(|d| d.current()?.adjustment.features.iter().find(|f| f.id == *id)?.direction)
            });
            let mut shown = self.layers.get();
            shown.push(("perspective", self.perspective.get()));
            SceneState {
                selected,
                photo,
                chosen: several,
                shown,
                factor: exaggeration(self.ellipsoids.get()),
                sticks: exaggeration(self.deviations.get()),
                along,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exaggerations_go_in_steps_of_one_two_five() {
        assert_eq!([0, 1, 2, 3, 10].map(exaggeration), [1.0, 2.0, 5.0, 10.0, 2000.0]);
        assert_eq!([1.0, 480.0, 0.1, 1e9].map(step_of), [0, 8, 0, STEPS]);
    }
}
