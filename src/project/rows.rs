//! A table of the project, shared by its copies until one of them changes it.

use std::ops::{Deref, DerefMut};
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Project;

/// A vector that is copied when it is changed, not when the project is: a copy of a project costs what it changes. It is used like the vector
/// that it holds, and serialised like it.
#[derive(Debug)]
pub struct Rows<T>(Arc<Vec<T>>);

impl<T> Rows<T> {
    /// No rows.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Whether both are the same table in memory; two that differ in memory may still be equal.
    #[must_use]
    pub fn shares(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// The vector behind the table, to track which tables are in use.
    #[must_use]
    pub fn shared(&self) -> &Arc<Vec<T>> {
        &self.0
    }
}

impl<T> Default for Rows<T> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<T> Clone for Rows<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T: PartialEq> PartialEq for Rows<T> {
    fn eq(&self, other: &Self) -> bool {
        self.shares(other) || *self.0 == *other.0
    }
}

impl<T: PartialEq> PartialEq<Vec<T>> for Rows<T> {
    fn eq(&self, other: &Vec<T>) -> bool {
        *self.0 == *other
    }
}

impl<T> Deref for Rows<T> {
    type Target = Vec<T>;

    fn deref(&self) -> &Vec<T> {
        &self.0
    }
}

impl<T: Clone> DerefMut for Rows<T> {
    fn deref_mut(&mut self) -> &mut Vec<T> {
        Arc::make_mut(&mut self.0)
    }
}

impl<T> From<Vec<T>> for Rows<T> {
    fn from(rows: Vec<T>) -> Self {
        Self(Arc::new(rows))
    }
}

impl<T, const N: usize> From<[T; N]> for Rows<T> {
    fn from(rows: [T; N]) -> Self {
        Self::from(Vec::from(rows))
    }
}

impl<T> From<Arc<Vec<T>>> for Rows<T> {
    fn from(rows: Arc<Vec<T>>) -> Self {
        Self(rows)
    }
}

impl<T: Clone> From<Rows<T>> for Vec<T> {
    fn from(rows: Rows<T>) -> Self {
        Arc::unwrap_or_clone(rows.0)
    }
}

impl<T> FromIterator<T> for Rows<T> {
    fn from_iter<I: IntoIterator<Item = T>>(rows: I) -> Self {
        Self::from(rows.into_iter().collect::<Vec<_>>())
    }
}

impl<T: Clone> Extend<T> for Rows<T> {
    fn extend<I: IntoIterator<Item = T>>(&mut self, rows: I) {
        Vec::extend(self, rows);
    }
}

impl<T: Clone> IntoIterator for Rows<T> {
    type Item = T;
    type IntoIter = std::vec::IntoIter<T>;

    fn into_iter(self) -> Self::IntoIter {
        Vec::from(self).into_iter()
    }
}

impl<'a, T> IntoIterator for &'a Rows<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<'a, T: Clone> IntoIterator for &'a mut Rows<T> {
    type Item = &'a mut T;
    type IntoIter = std::slice::IterMut<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        Arc::make_mut(&mut self.0).iter_mut()
    }
}

impl<T: Serialize> Serialize for Rows<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Rows<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(Self::from)
    }
}

impl Project {
    /// Takes the other's tables where they are equal, so that they are in memory once and compared no more.
    pub fn share_tables(&mut self, other: &Self) {
        fn share<T: PartialEq>(own: &mut Rows<T>, other: &Rows<T>) {
            if !own.shares(other) && own == other {
                *own = other.clone();
            }
        }
        share(&mut self.photos, &other.photos);
        share(&mut self.points, &other.points);
        share(&mut self.observations, &other.observations);
    }

    /// A copy of everything but photos, points and observations.
    #[must_use]
    pub fn without_tables(&self) -> Self {
        Self { photos: Rows::new(), points: Rows::new(), observations: Rows::new(), ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::Rows;

    #[test]
    fn a_copy_is_shared_until_one_of_the_two_changes() {
        let first = Rows::from(vec![1, 2, 3]);
        let mut second = first.clone();
        assert!(first.shares(&second));
        second.push(4);
        assert!(!first.shares(&second) && *first == [1, 2, 3] && *second == [1, 2, 3, 4]);
        second.pop();
        assert_eq!(first, second);
        assert_eq!(serde_json::to_string(&second).unwrap(), "[1,2,3]");
        assert_eq!(serde_json::from_str::<Rows<i32>>("[1,2,3]").unwrap(), first);
    }
}
