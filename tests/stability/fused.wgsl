// Whether the adapter rounds `fma` once or twice.
alias BatchInput = vec4f;
alias BatchOutput = vec2f;

fn batch(input: BatchInput) -> BatchOutput {
    let contracted = input.x * input.y + input.z;
    return vec2f(fma(input.x, input.y, input.z), contracted);
}
