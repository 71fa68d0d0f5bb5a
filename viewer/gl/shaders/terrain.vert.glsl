layout(location = 0) in vec3 position;  // where it is drawn
layout(location = 2) in vec3 spot;      // flat metric space: the same, but on a curved Earth
layout(location = 1) in float rise;     // of a moving vertex, in units of height
out vec3 place;
out vec3 fromEye;
out vec2 overGround;  // from the eye, in flat metric space
void main() {
  float risen = rise * metricScale.z;
  // A rise on a curved Earth is mostly the sag of a chord: colours and contours go by the heights at rest.
  place = vec3(spot.xy, earth.y > 0.0 ? spot.z : spot.z + risen);
  vec3 there = earth.y > 0.0 ? vec3(position.xy, position.z + risen * earth.x) : vec3(place.xy, place.z * lens.w);
  fromEye = (there - eyeHigh.xyz) - eyeLow.xyz;
  overGround = (place.xy - eyeGround.xy) - eyeGround.zw;
  gl_Position = clipOf(inView(fromEye), 1.0);
}
