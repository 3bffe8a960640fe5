//! The element that hosts the 3-D view: opening and closing the view, and what it is sent.

use leptos::html::Div;
use leptos::prelude::*;
use leptos::task::spawn_local;

use super::display::ShownScene;
use crate::browser::object::{Met, SceneState, SceneView};
use crate::store::Desk;

/// The 3-D view in its element.
#[derive(Clone, Copy)]
pub struct Host {
    pub element: NodeRef<Div>,
    view: StoredValue<Option<SceneView>, LocalStorage>,
    pub ready: RwSignal<bool>,
    /// Why there is no view.
    pub failure: RwSignal<Option<String>>,
}

impl Host {
    pub fn new() -> Self {
        Self {
            element: NodeRef::new(),
            view: StoredValue::new_local(None),
            ready: RwSignal::default(),
            failure: RwSignal::default(),
        }
    }

    /// Opens the view as soon as its element is there, and closes it with the component.
    pub fn open(self, on_met: impl FnMut(Met) + 'static) {
        self.element.on_load(move |element| {
            spawn_local(async move {
                match SceneView::open(element.into(), on_met).await {
                    // If the component has gone meanwhile, the view closes as it is dropped.
                    Ok(view) => {
                        if self.view.try_set_value(Some(view)).is_none() {
                            self.ready.set(true);
                        }
                    }
                    Err(detail) => {
                        let _ = self.failure.try_set(Some(detail));
                    }
                }
            });
        });
        on_cleanup(move || {
            let _ = self.view.try_set_value(None);
        });
    }

    /// Keeps the view at the present scene and state.
    pub fn follow(self, desk: Desk, shown: Memo<ShownScene>, state: Memo<SceneState>) {
        Effect::new(move |_| {
            let ShownScene { scene, .. } = shown.get();
            let pictures = desk.photos.files.with(|files| {
                let small = |id: &String| files.get(id).map(|file| file.small.clone());
                scene.photo_names.iter().map(small).collect::<Vec<_>>()
            });
            if self.ready.get() {
                self.with_view(|view| view.show(&scene, &pictures));
            }
        });
        Effect::new(move |_| {
            let state = state.get();
            shown.track();
            // The colours are those of the theme.
            desk.window.theme.track();
            if self.ready.get() {
                self.with_view(|view| view.state(&state));
            }
        });
    }

    pub fn with_view(self, act: impl Fn(&SceneView)) {
        self.view.try_with_value(|view| view.iter().for_each(act));
    }

    /// Turns the view to a side, by its own name of it.
    pub fn look(self, side: &'static str) {
        self.with_view(|view| view.look(side));
    }
}
