use crate::scratch::Scratch;

/// Works through strips or rims, on as many threads as there are scratches, each on its own part of the output: `split`
/// cuts the output that begins with one of them where another begins.
///
/// What a strip writes depends on nothing but the strip, so neither the number of threads nor their
/// pace can change a number.
pub(crate) fn share<P: Sync, O: Send>(
    (strips, scratches): (&[P], &mut [Scratch]),
    output: O,
    split: &(impl Fn(O, &P, &P) -> (O, O) + Sync),
    work: &(impl Fn(&P, &mut Scratch, O) + Sync),
) {
    let [.., last] = strips else { return };
    if scratches.len() < 2 || strips.len() < 2 {
        let mut output = output;
        for pair in strips.windows(2) {
            let (own, rest) = split(output, &pair[0], &pair[1]);
            work(&pair[0], &mut scratches[0], own);
            output = rest;
        }
        work(last, &mut scratches[0], output);
        return;
    }
    let threads = scratches.len();
    let (left, right) = scratches.split_at_mut(threads / 2);
    let middle = (strips.len() * left.len()).div_ceil(threads);
    let (here, there) = strips.split_at(middle.clamp(1, strips.len() - 1));
    let (output, rest) = split(output, &here[0], &there[0]);
    rayon::join(
        || share((here, left), output, split, work),
        || share((there, right), rest, split, work),
    );
}
