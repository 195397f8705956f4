// A bust that falls ill: it nods, its ears flap, its nose reddens and its skin goes green.
const float kUnitMetres = 0.6 / 4.34;          // metres per bust unit; the numbers below are in bust units
const vec3 kFoot = vec3(0.0, -3.1, -0.32);     // origin of positionOS
const vec3 kNeck = vec3(0.0, -0.75, -0.35);    // pivot of the nod
const vec3 kEar = vec3(0.72, -0.08, -0.12);    // pivot of the left ear, which turns about an upright axis
const vec3 kNose = vec3(0.0, -0.28, 0.95);

float illness()
{
    return smoothstep(0.0, hook.illAfterSeconds, hook.timeSeconds);
}

// Rotates y towards z.
vec3 nodded(vec3 place, float radians)
{
    vec3 arm = place - kNeck;
    float c = cos(radians), s = sin(radians);
    return kNeck + vec3(arm.x, c * arm.y - s * arm.z, s * arm.y + c * arm.z);
}

// The sicker, the lower the head hangs.
float nodRadians()
{
    return radians(hook.nodDegrees) * (0.5 * illness() + (0.5 - 0.3 * illness()) * sin(2.5 * hook.timeSeconds));
}

vec3 moved(vec3 positionOS)
{
    vec3 place = positionOS / kUnitMetres + kFoot;
    float side = place.x < 0.0 ? -1.0 : 1.0;
    vec3 arm = vec3(side * place.x, place.yz) - kEar;
    float ear = smoothstep(0.0, 0.12, arm.x) * (1.0 - smoothstep(0.8, 1.2, length(arm.yz / vec2(0.36, 0.34))));
    float turn = ear * radians(hook.earDegrees) * sin(9.0 * hook.timeSeconds) * (1.0 - 0.7 * illness());
    arm.xz = vec2(cos(turn) * arm.x - sin(turn) * arm.z, sin(turn) * arm.x + cos(turn) * arm.z);
    arm += kEar;
    place = vec3(side * arm.x, arm.yz);
    float head = smoothstep(-1.55, -0.8, place.y + 0.5 * place.z); // the neck bends, the chin belongs to the head
    return (nodded(place, head * nodRadians()) - kFoot) * kUnitMetres;
}

void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)
{
    vec3 along = normalize(cross(normalOS, abs(normalOS.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    vec3 across = cross(normalOS, along);
    const float kStepMetres = 0.002;
    vec3 place = moved(positionOS);
    normalOS = cross(moved(positionOS + kStepMetres * along) - place, moved(positionOS + kStepMetres * across) - place);
    positionOS = place;
}

void hookSurface(inout HookedSurface surface, HookInputs inputs)
{
    vec3 place = nodded(inputs.positionOS / kUnitMetres + kFoot, -nodRadians());
    // Excludes hair, which is dark, and eyes, which are grey.
    float skin = smoothstep(0.1, 0.3, surface.color.r) * smoothstep(0.1, 0.2, surface.color.r - surface.color.b);
    float light = dot(surface.color, vec3(0.3, 0.6, 0.1));
    surface.color = mix(surface.color, light * vec3(0.52, 1.2, 0.4), hook.green * illness() * skin);
    float nose = 1.0 - smoothstep(0.12, 0.34, distance(place, kNose));
    float beat = 0.75 + 0.25 * sin(5.0 * hook.timeSeconds);
    float red = hook.red * beat * nose * smoothstep(0.0, 0.5, illness());
    surface.color = mix(surface.color, vec3(0.75, 0.05, 0.03), red);
    surface.alpha = mix(surface.alpha, 0.22, 0.6 * illness() * skin); // it sweats
}
