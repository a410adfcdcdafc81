//! Torque along the crank by the three cases of \[Villalva 2014\] section 7.2, from torques on the throws and peaks of vibratory torque at the bearings.
//! The fourth way, the chain's own torque with phase, needs no model here: it is the response itself.

/// How torques of the throws and vibratory torques add up along the crank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Case {
    /// Both are summed up to the flywheel, eq. (7.20): the flywheel takes all at once. Far too severe for the vibratory torque.
    A,
    /// Each throw loads its own length only, eq. (7.21): an engine that runs free.
    B,
    /// Torques of the throws are summed; of the vibratory torques only the differences between neighbours, eq. (7.22).
    C,
}

impl Case {
    /// The case of a letter.
    pub fn of(letter: &str) -> Option<Self> {
        match letter {
            "A" => Some(Self::A),
            "B" => Some(Self::B),
            "C" => Some(Self::C),
            _ => None,
        }
    }
}

/// Torque in the front half and in the rear half of every throw, N m. `applied`: one a throw. `vibratory`: peak at every bearing, throws + 1; `sign` is
/// +1 for the largest load and -1 for the smallest, where it acts the other way.
pub fn halves(case: Case, applied: &[f64], vibratory: &[f64], sign: f64) -> Vec<[f64; 2]> {
    let (mut thrown, mut shaken) = (0.0, 0.0);
    (0..applied.len())
        .map(|i| {
            let before = thrown;
            thrown += applied[i];
            match case {
                Case::A => shaken += vibratory[i],
                Case::B => {
                    let own = sign * vibratory[i];
                    let previous = if i > 0 { applied[i - 1] } else { 0.0 };
                    return [previous + own, applied[i] + own];
                }
                Case::C => shaken += (vibratory[i] - vibratory[i + 1]).abs(),
            }
            [before + sign * shaken, thrown + sign * shaken]
        })
        .collect()
}
