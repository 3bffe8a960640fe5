//! How the desk looks: components that read the store and call its verbs.

pub mod adjust;
pub mod advice;
pub mod changes;
pub mod control;
pub mod experiments;
pub mod field;
pub mod gross_errors;
pub mod icon;
pub mod identities;
pub mod keys;
pub mod loupe;
pub mod photo_view;
pub mod photos;
pub mod picking;
pub mod planning;
pub mod plots;
pub mod printing;
pub mod projects;
pub mod report;
pub mod results;
pub mod shell;
pub mod start;
pub mod strip;
pub mod table;
pub mod targets;
pub mod transform;
