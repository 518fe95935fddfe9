// How things look: one cheap light model, worked out for each pixel or, on slow machines, for each vertex.
//
// A key light from above the viewer's left shoulder, sky and floor, a rim, and for metal the reflection of a plain
// studio: a bright ceiling over a dark horizon. All of it is arithmetic on the normal: no textures, no shadow maps.

import { THREE } from "nicegui-scene";

export const THEMES = {
  light: { back: "#f3f5f8", grid: "#c3cad3", shade: "#8b95a1", edge: "#10161d", mark: "#0b1118", sky: 1.0 },
  dark: { back: "#13171c", grid: "#323b46", shade: "#05070a", edge: "#000000", mark: "#ffffff", sky: 0.82 },
};

// Shared by all materials of one view: the theme changes in one place.
export function uniforms() {
  return {
    up: { value: new THREE.Vector3(0, 0, 1) }, // of the world, seen from the camera
    sky: { value: 1 },
    level: { value: new THREE.Vector2(1, 1) }, // opacity, brightness
  };
}

const LIGHT = /* glsl */ `
uniform vec3 up;
uniform float sky;
const vec3 KEY = vec3(-0.42, 0.66, 0.62);
vec3 lit(vec3 n, vec3 v, vec3 colour, float metal) {
  float height = dot(n, up);
  float key = max(dot(n, KEY), 0.0);
  float turned = 1.0 - max(dot(n, v), 0.0);
  float rim = turned * turned * turned;
  vec3 matte = colour * (sky * mix(vec3(0.24, 0.235, 0.23), vec3(0.56, 0.58, 0.62), 0.5 + 0.5 * height) + 0.78 * key);
  vec3 mirror = 2.0 * dot(n, v) * n - v;
  float over = dot(mirror, up);
  float studio = 0.22 + 0.5 * smoothstep(-0.25, 0.1, over) * (1.0 - 0.45 * smoothstep(0.1, 0.45, over))
    + 0.62 * smoothstep(0.5, 0.95, over) + 0.18 * smoothstep(-0.3, -0.95, over);
  float shine = max(dot(mirror, KEY), 0.0);
  shine *= shine; shine *= shine; shine *= shine; shine *= shine;
  vec3 tint = mix(vec3(1.0), colour, 0.75 * metal);
  vec3 sum = matte * (1.0 - 0.36 * metal) + tint * sky * studio * (0.05 + 0.27 * metal + 0.3 * rim)
    + tint * shine * (0.16 + 0.42 * metal);
  return sqrt(clamp(sum, 0.0, 1.0));
}
`;

const VERTEX = /* glsl */ `
#include <clipping_planes_pars_vertex>
attribute vec3 tone;
uniform float metal;
varying vec3 vTone;
#ifdef EACH_PIXEL
varying vec3 vNormal_;
varying vec3 vPlace;
#else
${LIGHT}
#endif
void main() {
  vec3 shown = tone;
  vec4 at = vec4(position, 1.0);
  vec3 facing = normal;
  #ifdef USE_INSTANCING
  at = instanceMatrix * at;
  facing = mat3(instanceMatrix) * facing;
  #endif
  #ifdef USE_INSTANCING_COLOR
  shown = instanceColor;
  #endif
  vec4 mvPosition = modelViewMatrix * at;
  vec3 n = normalize(mat3(modelViewMatrix) * facing);
  bool straight = projectionMatrix[2][3] == 0.0;
  #ifdef EACH_PIXEL
  vTone = shown;
  vNormal_ = n;
  vPlace = straight ? vec3(0.0, 0.0, -1.0) : mvPosition.xyz;
  #else
  vTone = lit(n, straight ? vec3(0.0, 0.0, 1.0) : normalize(-mvPosition.xyz), shown, metal);
  #endif
  gl_Position = projectionMatrix * mvPosition;
  #include <clipping_planes_vertex>
}
`;

// Of a body that is cut, what is seen of its inside is drawn flat: its material as the cut shows it.
const FRAGMENT = /* glsl */ `
#include <clipping_planes_pars_fragment>
uniform vec2 level;
varying vec3 vTone;
#ifdef EACH_PIXEL
varying vec3 vNormal_;
varying vec3 vPlace;
uniform float metal;
${LIGHT}
#endif
void main() {
  #include <clipping_planes_fragment>
  #if NUM_CLIPPING_PLANES > 0
  if (!gl_FrontFacing) {
    gl_FragColor = vec4(0.72 * sqrt(vTone) * level.y, level.x);
    return;
  }
  #endif
  #ifdef EACH_PIXEL
  gl_FragColor = vec4(lit(normalize(vNormal_), normalize(-vPlace), vTone, metal) * level.y, level.x);
  #else
  gl_FragColor = vec4(vTone * level.y, level.x);
  #endif
}
`;

// Return the two materials of one kind, `fast` and `fine`, that share their uniforms.
export function materials(shared, { metal, ghost = false }) {
  const all = { ...shared, metal: { value: metal ? 1 : 0 } };
  if (ghost) all.level = { value: new THREE.Vector2(0.16, 1) };
  const make = (defines) =>
    new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: all,
      defines,
      clipping: true,
      transparent: ghost,
      depthWrite: !ghost,
      polygonOffset: !ghost,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
  return { fast: make({}), fine: make({ EACH_PIXEL: 1 }) };
}

// "#rrggbb" as the light model wants it: its own square is its linear value, near enough.
export function tone(colour) {
  const value = parseInt(colour.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255].map((c) => (c / 255) ** 2);
}

// "#rrggbb" as it is written to the screen.
export function plain(colour) {
  const value = parseInt(colour.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255].map((c) => c / 255);
}
