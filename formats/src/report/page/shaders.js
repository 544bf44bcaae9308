const POSE = `uniform mat3 whole, now;
uniform vec3 wornMiddle, middle;
uniform vec2 flatMiddle;
uniform float share;
vec3 pose(vec3 worn, vec2 flat_) {
  vec3 own = transpose(whole) * (worn - wornMiddle);
  return middle + now * mix(vec3(flat_ - flatMiddle, 0.0), own, share);
}`;

// The light is that of the program's own pictures: light from around, a key light and a fill light, fixed to the eye.

const VERTEX = `#version 300 es
uniform mat4 camera;
uniform mat3 turn;
${POSE}
in vec3 position;
in vec3 normal;
in vec2 flat_;
in vec2 uv;
in vec2 open;
in float value;
out vec3 place, n;
out vec2 cloth, around;
out float number;
void main() {
  place = pose(position, flat_);
  n = turn * now * normalize(mix(vec3(0.0, 0.0, 1.0), transpose(whole) * normal, share));
  cloth = uv;
  around = mix(vec2(1.0), open, share);
  number = value;
  gl_Position = camera * vec4(place, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 colour;
uniform bool textured, mapped, isCloth;
uniform vec2 repeat;
uniform vec2 ends;
uniform vec3 stops[5];
uniform vec3 tint;
uniform float cut, skyUp;
uniform sampler2D weave;
in vec3 place, n;
in vec2 cloth, around;
in float number;
out vec4 pixel;
vec3 linear(vec3 c) { return pow(c, vec3(2.2)); }
void main() {
  if (place.y > cut) discard;
  vec3 up = normalize(n) * (gl_FrontFacing ? 1.0 : -1.0);
  float open = gl_FrontFacing ? around.x : around.y;
  vec3 base = colour.rgb;
  if (textured) base *= linear(texture(weave, cloth * repeat).rgb);
  if (mapped) {
    float at = clamp((number - ends.x) / (ends.y - ends.x), 0.0, 1.0) * 4.0;
    int k = int(min(at, 3.0));
    base = number < -1e8 ? vec3(0.34) : linear(mix(stops[k], stops[k + 1], at - float(k)));
  }
  vec3 key = normalize(vec3(-0.50, 0.62, 0.60)), fill = normalize(vec3(0.75, 0.10, 0.65));
  float wrap = isCloth ? 0.10 : 0.20;
  float soft = max(0.0, (dot(up, key) + wrap) / (1.0 + wrap));
  float light = mix(0.26, 0.50, 0.5 + 0.5 * up.y) * open
    + 0.72 * mix(0.35, 1.0, smoothstep(0.15, 0.75, open)) * soft
    + 0.16 * open * max(0.0, (dot(up, fill) + 0.3) / 1.3);
  if (mapped) light = 0.45 + 0.55 * light;
  float rim = 1.0 - min(1.0, abs(up.z));
  vec3 seen = base * light * (isCloth && !gl_FrontFacing ? 0.82 : 1.0);
  if (isCloth) seen += 0.07 * rim * rim * rim * open;
  seen = mix(seen, tint * light, tint.r > 0.0 ? 0.45 : 0.0);
  pixel = vec4(pow(clamp(seen, 0.0, 1.0), vec3(1.0 / 2.2)), colour.a);
}`;

// Lines are strips as wide on the screen as they should be.
const LINE_VERTEX = `#version 300 es
uniform mat4 camera;
uniform float width;
uniform vec2 size;
${POSE}
in vec3 from, to;
in vec2 fromFlat, toFlat;
in vec2 corner;
out vec3 place;
void main() {
  vec3 a = pose(from, fromFlat), b = pose(to, toFlat);
  vec4 p = camera * vec4(a, 1.0), q = camera * vec4(b, 1.0);
  vec2 along = normalize((q.xy - p.xy) * size + vec2(1e-6, 0.0));
  place = mix(a, b, corner.x);
  vec4 at = mix(p, q, corner.x);
  at.xy += vec2(-along.y, along.x) * corner.y * width / size;
  at.z -= 0.0012;
  gl_Position = at;
}`;

const LINE_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 colour;
uniform float cut;
in vec3 place;
out vec4 pixel;
void main() {
  if (place.y > cut) discard;
  pixel = colour;
}`;

const PICK_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 colour;
uniform float cut;
in vec3 place, n;
in vec2 cloth, around;
in float number;
out vec4 pixel;
void main() {
  if (place.y > cut) discard;
  pixel = colour;
}`;
