// A lit colour whose hue is replaced and whose light and shade stay, so that data on a surface do not hide its shape.

fn tinted(colour: vec3f, hue: vec3f) -> vec3f {
    let grey = dot(colour, vec3f(0.2126, 0.7152, 0.0722));
    return hue * mix(grey, 0.32, 0.4) * 1.8;
}
