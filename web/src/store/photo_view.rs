//! State of the photo view: layers, the cursor, and what it is asked to show.

use leptos::prelude::*;

/// Commands of keys to the photo view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewCommand {
    Fit,
    OneToOne,
    Nearer,
    Farther,
}

/// Layers drawn over photos, which can be switched off one by one, and how the photo itself is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layers {
    pub ellipses: bool,
    pub names: bool,
    pub predicted: bool,
    pub epipolar: bool,
    pub residuals: bool,
    /// Displacements between epochs.
    pub displacements: bool,
    /// Grid and values of the pixels, if the photo is magnified enough.
    pub pixels: bool,
    /// Exaggeration of residuals.
    pub residual_factor: f64,
    /// Brightness and contrast of photos; 1 leaves them unchanged.
    pub brightness: f64,
    pub contrast: f64,
}

impl Default for Layers {
    fn default() -> Self {
        Self {
            ellipses: true,
            names: true,
            predicted: true,
            epipolar: true,
            residuals: false,
            displacements: true,
            pixels: true,
            residual_factor: 100.0,
            brightness: 1.0,
            contrast: 1.0,
        }
    }
}

/// Signals of the photo view. Requests are set to `None` when the view has carried them out.
#[derive(Clone, Copy, Default)]
pub struct PhotoViewState {
    pub layers: RwSignal<Layers>,
    /// Position of the pointer in the photo, in pixels.
    pub cursor: RwSignal<Option<[f64; 2]>>,
    /// Request: bring this place of the photo into view.
    pub centre_on: RwSignal<Option<[f64; 2]>>,
    /// Request: magnify this place with so many pixels around it.
    pub show_place: RwSignal<Option<([f64; 2], f64)>>,
    /// Request of a key.
    pub command: RwSignal<Option<ViewCommand>>,
}
