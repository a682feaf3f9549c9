// Plans and shaders, made beforehand by `plans.sh`.

/** A plan below `plans`, or an error that says what to do. */
export const fetchPlan = async (name) => (await fetched(name)).json();

/** A text below `plans`. */
export const fetchText = async (name) => (await fetched(name)).text();

async function fetched(name) {
  let answer;
  try {
    answer = await fetch(`plans/${name}`);
  } catch (error) {
    throw new Error(`plans/${name} could not be fetched (${error.message}). Is the server still running? Reload the page to try again.`);
  }
  if (!answer.ok) throw new Error(`plans/${name} is not there (${answer.status} ${answer.statusText}). Run serve.mjs, which makes it.`);
  return answer;
}
