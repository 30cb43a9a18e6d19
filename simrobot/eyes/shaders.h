/* The programs that run on the graphics processor, as GLSL ES 3 text. */
#ifndef SIMROBOT_EYES_SHADERS_H
#define SIMROBOT_EYES_SHADERS_H

namespace sim
{

/* Scene: corners that are lit already, with or without a texture. */
inline constexpr char scene_vertex_shader[] = R"(#version 300 es
uniform mat4 view;
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
layout(location = 2) in vec2 texture_at;
out mediump vec3 shade;
out highp vec2 at;
void main()
{
    gl_Position = view * vec4(position, 1.0);
    shade = colour.rgb;
    at = texture_at;
}
)";

inline constexpr char plain_fragment_shader[] = R"(#version 300 es
precision mediump float;
in vec3 shade;
out vec4 pixel;
void main()
{
    pixel = vec4(shade, 1.0);
}
)";

inline constexpr char textured_fragment_shader[] = R"(#version 300 es
precision mediump float;
uniform sampler2D picture;
in vec3 shade;
in highp vec2 at;
out vec4 pixel;
void main()
{
    pixel = vec4(shade * texture(picture, at).rgb, 1.0);
}
)";

/* The ball is no mesh: each pixel of a square around it is a ray that meets a perfect sphere, so
 * that its outline has no corners, and pixels on it are covered in part. */
inline constexpr char ball_vertex_shader[] = R"(#version 300 es
uniform vec4 square; /* u_low, v_low, u_high, v_high: on the plane x = 1 of the eye */
uniform vec2 scale;  /* from that plane to clip space */
out highp vec2 ray;
void main()
{
    ray = vec2((gl_VertexID & 1) == 0 ? square.x : square.z,
               (gl_VertexID & 2) == 0 ? square.y : square.w);
    gl_Position = vec4(ray * scale, 0.0, 1.0);
}
)";

inline constexpr char ball_fragment_shader[] = R"(#version 300 es
precision highp float;
uniform vec3 centre;  /* of the ball in the eye's frame, m */
uniform float radius; /* m */
uniform vec3 paint;
uniform vec3 lamp_direction; /* in the eye's frame */
uniform vec3 lamp, ambient, up;
uniform float pixel_angle; /* rad */
uniform vec2 depth;        /* depth buffer = depth.x + depth.y / distance along x */
in vec2 ray;
out vec4 pixel;
void main()
{
    vec3 direction = normalize(vec3(1.0, -ray.x, -ray.y));
    float along = dot(direction, centre);
    float off = length(centre - along * direction);
    float coverage = clamp(0.5 + (radius - off) / (along * pixel_angle), 0.0, 1.0);
    if (coverage <= 0.0)
        discard;
    float before = sqrt(max(radius * radius - off * off, 0.0));
    vec3 hit = (along - before) * direction;
    vec3 normal = normalize(hit - centre);
    float sky = 0.75 + 0.25 * dot(normal, up);
    float shine = max(dot(reflect(direction, normal), lamp_direction), 0.0);
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine * shine; /* to the power of 24: powers and roots are dear without a GPU */
    vec3 light = lamp * max(dot(normal, lamp_direction), 0.0) + ambient * sky;
    pixel = vec4(paint * light + 0.16 * shine * lamp, coverage);
    gl_FragDepth = depth.x + depth.y / hit.x;
}
)";

} // namespace sim
#endif
