// How a script with one argument is called and ends.

// Runs `main` with the argument of the process, and ends that: with 0 where it passed, with 1 where it did not or threw, with 2 where `usage`
// is not kept to.
export async function command(usage, main) {
  if (process.argv.length !== 3) {
    console.error(`usage: ${usage}`);
    process.exit(2);
  }
  try {
    const passed = await main(process.argv[2]);
    // An open device keeps the process alive.
    process.exit(passed ? 0 : 1);
  } catch (error) {
    console.error(error.message);
    process.exit(1);
  }
}
