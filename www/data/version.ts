/** The version of the package, as in package.json: a test compares them. Files say which version wrote them. */

export const VERSION = '0.2.0';
