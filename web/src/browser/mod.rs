//! Everything that speaks JavaScript: files, workers, canvases, storage, keys. Nothing else in the desk does.

pub mod canvas;
pub mod event;
pub mod file;
pub mod object;
pub mod page;
pub mod paper;
pub mod picture;
pub mod storage;
pub mod worker;
