// In: the text of a path filter. Out: its words, each with its place. As src/trace/filter_words.cpp.

export interface Span { at: number; length: number }
export interface Word { kind: 'word' | 'quoted' | 'symbol' | 'end'; text: string; span: Span }

/// What is wrong with a filter, and where.
export class FilterError extends Error {
    constructor(readonly text: string, readonly span: Span, readonly problem: string, readonly remedy: string) {
        super(`${problem}; ${remedy}`);
    }
}

const symbols = '()[],<>=!';
const isBlank = (c: string) => c === ' ' || c === '\t' || c === '\n' || c === '\r';
const isQuote = (c: string) => c === '"' || c === "'";
const endsWord = (c: string) => isBlank(c) || isQuote(c) || symbols.includes(c);

/// A name as it has to be written in a filter: in quotes where it is not a plain word.
export function asFilterName(name: string): string {
    const plain = name.length > 0 && ![...name].some(c => endsWord(c) || c === '*' || c === '?' || c === '\\' || c < ' ');
    return plain ? name : `"${name.replace(/["\\]/g, c => `\\${c}`)}"`;
}

export function filterWords(text: string): Word[] {
    const words: Word[] = [];
    for (let at = 0; at < text.length;) {
        const start = at, c = text[at]!;
        if (isBlank(c)) {
            ++at;
        } else if (isQuote(c)) {
            let name = '';
            for (++at; at < text.length && text[at] !== c; ++at) {
                if (text[at] === '\\' && at + 1 < text.length) ++at;
                name += text[at];
            }
            if (at >= text.length)
                throw new FilterError(text, { at: start, length: text.length - start }, 'these quotes are not closed', `close them with ${c}`);
            ++at;
            words.push({ kind: 'quoted', text: name, span: { at: start, length: at - start } });
        } else if (symbols.includes(c)) {
            at += '<>!='.includes(c) && text[at + 1] === '=' ? 2 : 1;
            words.push({ kind: 'symbol', text: text.slice(start, at), span: { at: start, length: at - start } });
        } else {
            while (at < text.length && !endsWord(text[at]!)) ++at;
            words.push({ kind: 'word', text: text.slice(start, at), span: { at: start, length: at - start } });
        }
    }
    words.push({ kind: 'end', text: '', span: { at: text.length, length: 1 } });
    return words;
}
