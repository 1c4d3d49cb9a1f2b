// In: the text of a path filter (docs/filters.md). Out: its conditions and how they are joined, names not yet looked up.
// The same grammar as src/trace/filter_syntax.cpp.
import { eventNames } from './events';
import { FilterError, filterWords, type Span, type Word } from './filter_words';

export interface FilterName { text: string; exact: boolean; span: Span }

/// One event of a path, as it is described: `reflected(lens.front)`, `3 reflected`, `hits(lens)`, `any`.
export interface Step { events: number; surface?: FilterName; times: number }

export type Compare = '<' | '<=' | '=' | '!=' | '>=' | '>' | 'in';
export interface Comparison { how: Compare; value: number; to: number }

export type Quantity = 'wavelength_nm' | 'power_W' | 'share' | 'depth' | 'optical_path_mm' | 'ray';

export type Condition =
    | { question: 'count'; steps: [Step]; comparison: Comparison }
    | { question: 'through'; name: FilterName; comparison: Comparison }
    | { question: 'source'; name: FilterName }
    | { question: 'ends'; steps: [Step] }
    | { question: 'order' | 'run' | 'path'; steps: Step[] }
    | { question: 'quantity'; quantity: Quantity; comparison: Comparison };

/// A program for a stack of truths: the number of a condition, or what joins.
export type Join = number | 'not' | 'and' | 'or';

export interface Syntax { text: string; conditions: Condition[]; program: Join[] }

const mostNested = 200, mostSteps = 1 << 20, mostInRun = 64;
const everyEvent = (1 << eventNames.length) - 1;
const quantities: Quantity[] = ['wavelength_nm', 'power_W', 'share', 'depth', 'optical_path_mm', 'ray'];
const comparisons: Record<string, Compare> = { '<': '<', '<=': '<=', '=': '=', '==': '=', '!=': '!=', '>=': '>=', '>': '>' };
const atLeastOnce: Comparison = { how: '>=', value: 1, to: 0 };

function eventCalled(word: Word): number | undefined {
    const code = word.kind === 'word' ? eventNames.indexOf(word.text as (typeof eventNames)[number]) : -1;
    return code >= 2 ? code : undefined;
}

function numberOf(word: Word): number | undefined {
    return word.kind === 'word' && /^-?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(word.text) && Number.isFinite(Number(word.text))
        ? Number(word.text) : undefined;
}

class Parser {
    private readonly words: Word[];
    private next = 0;
    private nested = 0;
    private readonly conditions: Condition[] = [];
    private readonly program: Join[] = [];

    constructor(private readonly text: string) {
        this.words = filterWords(text);
    }

    parse(): Syntax {
        if (this.words.length > 1) {
            this.either();
            if (!this.atEnd()) this.refuse(`'${this.now().text}' has no place here`, 'join conditions with and, or');
        }
        return { text: this.text, conditions: this.conditions, program: this.program };
    }

    private now(): Word { return this.words[this.next]!; }
    private atEnd(): boolean { return this.now().kind === 'end'; }
    private is(what: string): boolean {
        const word = this.now();
        return (word.kind === 'word' || word.kind === 'symbol') && word.text === what;
    }
    private take(what: string): boolean {
        const there = this.is(what);
        if (there) ++this.next;
        return there;
    }
    private refuse(problem: string, remedy: string, span = this.now().span): never {
        throw new FilterError(this.text, span, problem, remedy);
    }
    private missing(what: string): string {
        return this.atEnd() ? `${what} is missing at the end` : `${what} should stand here, not '${this.now().text}'`;
    }
    private need(symbol: string): void {
        if (!this.take(symbol)) this.refuse(this.missing(`'${symbol}'`), 'see docs/filters.md');
    }

    private either(): void {
        this.both();
        while (this.take('or')) {
            this.both();
            this.program.push('or');
        }
    }
    private both(): void {
        this.negated();
        while (this.take('and')) {
            this.negated();
            this.program.push('and');
        }
    }
    private negated(): void {
        if (++this.nested > mostNested) this.refuse('this filter is nested too deeply', 'write it with fewer brackets');
        if (this.take('not')) {
            this.negated();
            this.program.push('not');
        } else if (this.take('(')) {
            this.either();
            this.need(')');
        } else {
            this.program.push(this.conditions.length);
            this.conditions.push(this.condition());
        }
        --this.nested;
    }

    private condition(): Condition {
        const word = this.now();
        const quantity = quantities.find(q => word.kind === 'word' && q === word.text);
        if (quantity) {
            ++this.next;
            const comparison = this.comparison();
            if (!comparison)
                this.refuse(this.missing(`a comparison of ${quantity}`), `compare it: ${quantity} < 1, or ${quantity} in [1, 2]`);
            return { question: 'quantity', quantity, comparison };
        }
        if (this.take('ends')) return this.ending();
        for (const question of ['order', 'run', 'path'] as const)
            if (this.take(question)) return { question, steps: this.steps(question) };
        if (this.take('source')) return { question: 'source', name: this.nameInBrackets('a source') };
        if (this.take('through')) {
            const name = this.nameInBrackets('a medium');
            return { question: 'through', name, comparison: this.comparison() ?? atLeastOnce };
        }
        const event = eventCalled(word);
        if (event === undefined && !this.is('hits'))
            this.refuse(this.atEnd() ? 'a condition is missing at the end' : `'${word.text}' is no condition`,
                'give one such as hits(lens.front), reflected >= 2 or ends(screen)');
        const step = this.step(event);
        return { question: 'count', steps: [step], comparison: this.comparison() ?? atLeastOnce };
    }

    private ending(): Condition {
        this.need('(');
        const event = eventCalled(this.now());
        const step: Step = event !== undefined
            ? this.step(event) : { events: everyEvent, surface: this.name('a surface, a detector or an event'), times: 1 };
        this.need(')');
        return { question: 'ends', steps: [step] };
    }

    /// At the word of the event, or at `hits`.
    private step(event: number | undefined): Step {
        ++this.next;
        if (event === undefined) return { events: everyEvent, surface: this.nameInBrackets('a surface or a detector'), times: 1 };
        const made: Step = { events: 1 << event, times: 1 };
        if (this.is('(')) made.surface = this.nameInBrackets('a surface or a detector');
        return made;
    }

    private steps(question: 'order' | 'run' | 'path'): Step[] {
        const list: Step[] = [];
        let total = 0;
        this.need('(');
        do {
            const start = this.now().span, times = numberOf(this.now());
            if (times !== undefined) {
                if (!(times >= 1 && times <= mostSteps) || times !== Math.floor(times))
                    this.refuse(`'${this.now().text}' is no number of times`, 'give a whole number from 1 on');
                ++this.next;
            }
            const event = eventCalled(this.now());
            let made: Step;
            if (event !== undefined || this.is('hits')) made = this.step(event);
            else if (this.take('any')) made = { events: everyEvent, times: 1 };
            else return this.refuse(this.missing('an event'), 'give one such as reflected(lens.front), hits(lens) or any');
            made.times = times ?? 1;
            list.push(made);
            total += made.times;
            const most = question === 'run' ? mostInRun : mostSteps;
            if (total > most) this.refuse(`these are more than ${most} events`, 'give fewer', start);
        } while (this.take(','));
        this.need(')');
        return list;
    }

    private name(of: string): FilterName {
        const word = this.now();
        if (word.kind !== 'word' && word.kind !== 'quoted') this.refuse(this.missing(`the name of ${of}`), 'give one, or * for any');
        ++this.next;
        return { text: word.text, exact: word.kind === 'quoted', span: word.span };
    }
    private nameInBrackets(of: string): FilterName {
        this.need('(');
        const made = this.name(of);
        this.need(')');
        return made;
    }

    private comparison(): Comparison | undefined {
        if (this.take('in')) {
            this.need('[');
            const value = this.number();
            this.need(',');
            const upper = this.now().span, to = this.number();
            if (to < value) this.refuse('this range ends before it begins', 'give the lower bound first', upper);
            this.need(']');
            return { how: 'in', value, to };
        }
        const word = this.now();
        const how = word.kind === 'symbol' && Object.hasOwn(comparisons, word.text) ? comparisons[word.text] : undefined;
        if (!how) return undefined;
        ++this.next;
        return { how, value: this.number(), to: 0 };
    }
    private number(): number {
        const value = numberOf(this.now());
        if (value === undefined) this.refuse(this.missing('a number'), 'give one, such as 2 or 1e-3');
        ++this.next;
        return value;
    }
}

export function holds({ how, value, to }: Comparison, x: number): boolean {
    switch (how) {
        case '<': return x < value;
        case '<=': return x <= value;
        case '=': return x === value;
        case '!=': return x !== value;
        case '>=': return x >= value;
        case '>': return x > value;
        case 'in': return x >= value && x <= to;
    }
}

/// Throws FilterError. An empty text selects every path.
export function parseFilter(text: string): Syntax {
    return new Parser(text).parse();
}
