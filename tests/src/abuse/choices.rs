//! Random choices.

/// Source of choices: a seed, or the bytes of a fuzzer.
#[derive(Clone, Debug)]
pub struct Choices<'b> {
    state: u64,
    bytes: Option<&'b [u8]>,
}

impl<'b> Choices<'b> {
    /// Creates choices from a seed; equal seeds give equal choices.
    pub fn seeded(seed: u64) -> Self {
        Self { state: seed, bytes: None }
    }

    /// Creates choices from bytes. All further choices are 0 after their end.
    pub fn of_bytes(bytes: &'b [u8]) -> Self {
        Self { state: 0, bytes: Some(bytes) }
    }

    /// Returns the next number of SplitMix64, by Steele, Lea and Flood, *Fast splittable
    /// pseudorandom number generators*, 2014.
    fn next(&mut self) -> u64 {
        if let Some(bytes) = &mut self.bytes {
            let taken = bytes.len().min(2);
            let value = bytes[..taken].iter().fold(0, |value, byte| value << 8 | u64::from(*byte));
            *bytes = &bytes[taken..];
            return value;
        }
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.state ^ (self.state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a number below `n`, or 0 if `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }

    /// Returns `true` with probability 1/n.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) + 1 == n
    }

    /// Returns one of a nonempty list.
    pub fn one_of<'t, T>(&mut self, these: &'t [T]) -> &'t T {
        &these[self.below(these.len())]
    }

    /// Returns a number with two decimals between two integers.
    pub fn decimal(&mut self, from: i32, to: i32) -> String {
        let steps = self.below(100 * (to - from).unsigned_abs() as usize + 1);
        format!("{:.2}", f64::from(from) + steps as f64 / 100.0)
    }
}
