//! Tests of `shard.rs`.

use super::Shard;

#[test]
fn shards_are_all_chunks_one_after_the_other() {
    for (all, count) in [(0, 3), (1, 1), (5, 7), (64, 7), (244_141, 64)] {
        let mut next = 0;
        for number in 1..=count {
            let chunks = Shard::new(number, count).unwrap().chunks(all);
            assert_eq!(chunks.start, next);
            assert!(chunks.len() <= all.div_ceil(count as usize));
            next = chunks.end;
        }
        assert_eq!(next, all);
    }
}

#[test]
fn text_round_trips() {
    assert_eq!("3/7".parse::<Shard>().unwrap().to_string(), "3/7");
    for text in ["0/7", "8/7", "1/0", "1/100001", "3", "a/b", "-1/3", "1/3/4"] {
        assert!(text.parse::<Shard>().is_err(), "{text}");
    }
}
