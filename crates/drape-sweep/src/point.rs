//! Points of a study, and shards of the points.

use std::path::PathBuf;

use drape_input::Setting;

/// Largest number of points of a study. Each point takes memory and a file.
pub(crate) const POINTS_MAX: usize = 1_000_000;

/// One run of a study.
#[derive(Debug, Clone)]
pub struct Point {
    /// Number of the point in the order of the plan, from 0.
    pub index: usize,
    /// BLAKE3 digest of everything that the run reads, in hexadecimal digits.
    pub key: String,
    /// Level of each axis, in the order of the axes, as a TOML value.
    pub levels: Vec<String>,
    /// File of the base.
    pub file: PathBuf,
    /// Settings of keys of the base.
    pub settings: Vec<Setting>,
}

/// Part of the points of a study: every n-th point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number of the shard, from 1.
    index: usize,
    /// Number of shards.
    count: usize,
}

impl Shard {
    /// Returns whether the point with the number `index` in the order of the plan is in this shard.
    #[must_use]
    pub fn contains(self, index: usize) -> bool {
        index % self.count == self.index - 1
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(index, count)| {
            Some(Self { index: index.trim().parse().ok()?, count: count.trim().parse().ok()? })
        });
        let shard = numbers.filter(|shard| (1..=shard.count).contains(&shard.index));
        shard.ok_or_else(|| "write i/n, the part and the number of parts, such as 1/4".into())
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_all_points() {
        for index in 0..10 {
            let shards = ["1/3", "2/3", "3/3"].map(|text| text.parse::<Shard>().expect("right"));
            assert_eq!(shards.iter().filter(|shard| shard.contains(index)).count(), 1);
        }
        for wrong in ["0/3", "4/3", "1", "a/b", "1/0"] {
            assert!(wrong.parse::<Shard>().expect_err("wrong").contains("such as 1/4"));
        }
        assert!("1/4".parse::<Shard>().is_ok());
    }
}
