// Plans, compiled beforehand by `plans.sh`.

/** A file below `plans`, or an error that says what to do. */
export async function fetchPlan(name) {
  let answer;
  try {
    answer = await fetch(`plans/${name}`);
  } catch (error) {
    throw new Error(`plans/${name} could not be fetched (${error.message}). Open the page from a web server, not as a file.`);
  }
  if (!answer.ok) throw new Error(`plans/${name} is not there (${answer.status} ${answer.statusText}). Run plans.sh, which compiles it.`);
  return answer.json();
}
