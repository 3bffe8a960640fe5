//! Interface to JavaScript: files, workers, canvases, storage, keys. No other part of the desk calls it directly.

pub mod canvas;
pub mod event;
pub mod file;
pub mod object;
pub mod page;
pub mod paper;
pub mod picture;
pub mod storage;
pub mod worker;
