/** How the language server is started: what needs no editor to be tried. */

export interface Program {
  command: string;
  args: string[];
}

/** Where lists and project files are, for the client and for what it watches. */
export const WATCHED = "**/*.{lis,LIS,csv,exc,tsproj,xti,toml}";

export const SELECTOR = [
  { scheme: "file", language: "lis" },
  { scheme: "file", pattern: "**/*.{tsproj,xti}" },
];

/** Program and arguments from the setting `axcomp.command`; the usual ones where it is empty. */
export function programOf(setting: readonly string[] | undefined): Program {
  const [command = "axcomp", ...args] = setting?.length ? setting : ["axcomp", "lsp"];
  return { command, args };
}
