use crate::scene::Colour;

/// Colours of the lower end, the middle and the upper end: blue, nearly white, red.
const STOPS: [Colour; 3] = [[33, 92, 172], [246, 246, 244], [186, 38, 48]];

/// The colour of a value on a scale that shows nought as nearly white, what is below as blue and above as red.
///
/// The ends are plus and minus the limit; what is beyond has their colour.
pub fn diverging(value: f64, limit: f64) -> Colour {
    let part = if limit > 0.0 { (value / limit).clamp(-1.0, 1.0) } else { 0.0 };
    let end = if part < 0.0 { STOPS[0] } else { STOPS[2] };
    std::array::from_fn(|channel| {
        let (middle, end) = (f64::from(STOPS[1][channel]), f64::from(end[channel]));
        (middle + part.abs() * (end - middle)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nought_is_light_and_the_ends_are_kept() {
        assert_eq!(diverging(0.0, 2.0), STOPS[1]);
        assert_eq!([diverging(-2.0, 2.0), diverging(9.0, 2.0)], [STOPS[0], STOPS[2]]);
        let half = diverging(1.0, 2.0);
        assert!(half[0] > half[1] && half[1] > STOPS[2][1], "{half:?}");
        assert_eq!(diverging(1.0, 0.0), STOPS[1]);
    }
}
