use super::*;

const SIZE: [u32; 2] = [96, 64];

/// A picture of a disc with a pattern on a grey ground, moved by some pixels, with noise.
fn disc(shift: f64, noise: f64) -> Vec<u8> {
    let mut bytes = Vec::new();
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let (dx, dy) = (f64::from(x) - 48.0 - shift, f64::from(y) - 32.0);
            let value = if dx.hypot(dy) < 24.0 {
                150.0 + 60.0 * (dx * 0.5).sin() * (dy * 0.4).cos()
            } else {
                40.0
            };
            let grain = (f64::from(x * 131 + y * 313).sin() * 43758.5453).rem_euclid(1.0) - 0.5;
            let value = (value + noise * grain).clamp(0.0, 255.0) as u8;
            bytes.extend([value, value, value, 255]);
        }
    }
    bytes
}

fn errors(a: &[u8], b: &[u8]) -> PictureError {
    let [a, b] = [a, b].map(|bytes| Picture::new(bytes, SIZE).unwrap());
    picture_error(&a, &b, &Mask::everything(&a)).unwrap()
}

#[test]
fn one_level_everywhere_is_48_decibels_and_equal_pictures_are_infinite() {
    let grey = [100u8, 100, 100, 255].repeat(96 * 64);
    let lighter = [101u8, 101, 101, 0].repeat(96 * 64);
    let one_level = errors(&grey, &lighter);
    assert!((one_level.psnr.unwrap() - 20.0 * 255f64.log10()).abs() < 1e-12);
    let equal = errors(&grey, &grey);
    assert_eq!((equal.psnr, equal.covered), (None, 1.0));
    assert!((equal.ssim - 1.0).abs() < 1e-12);
}

#[test]
fn more_noise_and_larger_shifts_are_worse() {
    let reference = disc(0.0, 0.0);
    for pair in [[disc(0.0, 4.0), disc(0.0, 16.0)], [disc(1.0, 0.0), disc(3.0, 0.0)]] {
        let [less, more] = pair.map(|picture| errors(&picture, &reference));
        assert!(
            less.psnr > more.psnr && less.ssim > more.ssim && less.ssim < 1.0,
            "{less:?} {more:?}"
        );
    }
}

/// The formula of the paper, word by word, at one pixel: equations 13 to 16 with the window of section IV.
fn similarity_by_definition(a: &[u8], b: &[u8], x: i64, y: i64) -> f64 {
    let value = |bytes: &[u8], x: i64, y: i64| f64::from(bytes[4 * (y * i64::from(SIZE[0]) + x) as usize]);
    let window: Vec<(f64, f64, f64)> = (-5..=5)
        .flat_map(|dy| (-5..=5).map(move |dx| (dx, dy)))
        .map(|(dx, dy)| {
            let weight = (-((dx * dx + dy * dy) as f64) / (2.0 * 1.5 * 1.5)).exp();
            (weight, value(a, x + dx, y + dy), value(b, x + dx, y + dy))
        })
        .collect();
    let total: f64 = window.iter().map(|(weight, ..)| weight).sum();
    let mean = |f: &dyn Fn(f64, f64) -> f64| window.iter().map(|(w, p, q)| w * f(*p, *q)).sum::<f64>() / total;
    let (mx, my) = (mean(&|p, _| p), mean(&|_, q| q));
    let (vx, vy) = (mean(&|p, _| (p - mx).powi(2)), mean(&|_, q| (q - my).powi(2)));
    let covariance = mean(&|p, q| (p - mx) * (q - my));
    let (c1, c2) = ((0.01f64 * 255.0).powi(2), (0.03f64 * 255.0).powi(2));
    (2.0 * mx * my + c1) * (2.0 * covariance + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2))
}

#[test]
fn similarity_is_that_of_the_definition() {
    let reference = disc(0.0, 0.0);
    for picture in [disc(0.0, 8.0), disc(0.0, 40.0), disc(1.5, 0.0)] {
        for (x, y) in [(48, 32), (25, 30), (7, 8), (70, 40)] {
            let one = (0..SIZE[0] * SIZE[1]).map(|i| i == y * SIZE[0] + x).collect();
            let [a, b] = [&picture, &reference].map(|bytes| Picture::new(bytes, SIZE).unwrap());
            let found = structural_similarity(&a, &b, &Mask::new(one)).unwrap();
            let expected = similarity_by_definition(&picture, &reference, x.into(), y.into());
            assert!((found - expected).abs() < 1e-9, "({x}, {y}): {found} {expected}");
        }
    }
}

#[test]
fn a_mask_leaves_the_background_out() {
    let (shifted, reference) = (disc(2.0, 0.0), disc(0.0, 0.0));
    let [a, b] = [&shifted, &reference].map(|bytes| Picture::new(bytes, SIZE).unwrap());
    let drawn = a.differing_from([40; 3]).or(&b.differing_from([40; 3])).unwrap();
    let all = picture_error(&a, &b, &Mask::everything(&a)).unwrap();
    let masked = picture_error(&a, &b, &drawn).unwrap();
    assert!(masked.covered > 0.28 && masked.covered < 0.35, "{masked:?}");
    assert!(masked.ssim < all.ssim && masked.psnr < all.psnr);
    // All differences lie in the mask, so that the squared error is spread over fewer pixels.
    assert!((all.psnr.unwrap() - masked.psnr.unwrap() + 10.0 * masked.covered.log10()).abs() < 1e-9);
}

#[test]
fn what_does_not_fit_is_refused() {
    let bytes = disc(0.0, 0.0);
    assert!(matches!(
        Picture::new(&bytes[1..], SIZE),
        Err(PictureFault::Size { .. })
    ));
    assert!(matches!(Picture::new(&[], [0, 7]), Err(PictureFault::Size { .. })));
    let picture = Picture::new(&bytes, SIZE).unwrap();
    let turned = Picture::new(&bytes, [64, 96]).unwrap();
    let all = Mask::everything(&picture);
    assert!(matches!(
        psnr(&picture, &turned, &all),
        Err(PictureFault::Different(..))
    ));
    assert!(matches!(
        psnr(&picture, &picture, &Mask::new(vec![true])),
        Err(PictureFault::Different(..))
    ));
    let nothing = Mask::new(vec![false; 96 * 64]);
    assert_eq!(psnr(&picture, &picture, &nothing), Err(PictureFault::Nothing));
}
