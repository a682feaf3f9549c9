// What is linked of files:
// clear_codes.wgsl: view_ray_codes clear_codes

// specialization
const GROUP = 0;
const EXTENT = vec2u(1024u, 1024u);

