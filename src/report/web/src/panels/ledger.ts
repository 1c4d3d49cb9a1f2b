// In: the energy ledger of a summary. Out: whether it closes, and one bar that adds up to what was emitted.
import { at, entriesAt, numberAt, type Json } from '../data';
import { details, h, table } from '../dom';
import { count, figure, percent } from '../numbers';

const terms: [name: string, meaning: string][] = [
    ['detected', 'met an absorbing detector'], ['absorbed', 'was lost in media and at surfaces'], ['escaped', 'left the scene'],
    ['cut', 'branches too weak or too deep to follow'], ['error', 'leaks and invalid rays']];

const limitLedger = 1e-12, limitLeak = 1e-6; // where the options do not say otherwise

function verdict(good: boolean, text: string): HTMLElement {
    return h('p', { class: good ? 'good' : 'bad' }, `${good ? '✓' : '⚑'} ${text}`);
}

function verdicts(summary: Json): HTMLElement[] {
    const out: HTMLElement[] = [];
    const emitted = numberAt(summary, 'energy_W', 'emitted'), remainder = numberAt(summary, 'energy_W', 'remainder');
    const limit = numberAt(summary, 'options', 'limit_ledger') ?? limitLedger;
    const closes = emitted !== undefined && remainder !== undefined && Math.abs(remainder) <= limit * emitted;
    const share = emitted && remainder !== undefined ? figure(Math.abs(remainder) / emitted, 3) : 'not stated';
    out.push(verdict(closes, `The ledger ${closes ? 'closes' : 'does not close'}: remainder ${share} of the emitted power; limit ${figure(limit)}.`));
    const all = entriesAt(summary, 'events').reduce((sum, [name, n]) => sum + (name !== 'recovered' && typeof n === 'number' ? n : 0), 0);
    const lost = (numberAt(summary, 'events', 'leak') ?? 0) + (numberAt(summary, 'events', 'invalid') ?? 0);
    const limitOfLeaks = numberAt(summary, 'options', 'limit_leak') ?? limitLeak;
    if (lost > limitOfLeaks * all)
        out.push(verdict(false, `Segments that leaked or were invalid: ${count(lost)}. That is above the limit of ${figure(limitOfLeaks)} of the events.`));
    return out;
}

/// The numbers of a tree of tables, each with the keys that lead to it.
function leaves(value: Json | undefined, place: string, out: [number, string][]): void {
    if (typeof value === 'number' && value > 0) out.push([value, place]);
    else if (typeof value === 'object' && value !== null && !Array.isArray(value))
        for (const [key, entry] of Object.entries(value)) leaves(entry, place ? `${place} › ${key}` : key, out);
}

function absorbers(summary: Json, emitted: number): HTMLElement | undefined {
    const places: [number, string][] = [], most = 40;
    leaves(at(summary, 'absorbed_W'), '', places);
    if (places.length === 0) return undefined;
    places.sort((a, b) => b[0] - a[0]);
    return details('Where light was absorbed',
        table(['absorbed in', 'power (W)', 'share of emitted'], places.slice(0, most).map(([power, place]) => [place, figure(power), percent(power / emitted)])),
        places.length > most && h('p', { class: 'note' }, `The strongest of ${count(places.length)} places.`));
}

export function ledgerPanel(summary: Json): HTMLElement | undefined {
    const emitted = numberAt(summary, 'energy_W', 'emitted');
    if (emitted === undefined) return undefined;
    const powers = terms.map(([name]) => Math.max(0, numberAt(summary, 'energy_W', name) ?? 0));
    const sum = powers.reduce((a, b) => a + b, 0);
    const bar = h('div', { class: 'ledger-bar', attr: { role: 'img', 'aria-label': 'Where the emitted power went' } });
    terms.forEach(([name], i) => {
        const share = sum > 0 ? powers[i]! / sum : 0;
        if (share <= 0) return;
        const part = h('span', { class: `term ${name}`, title: `${name}: ${figure(powers[i])} W, ${percent(share)}` }, share > 0.09 && h('b', {}, `${name} ${percent(share, 3)}`));
        part.style.flexGrow = String(share);
        part.dataset.share = String(share);
        bar.append(part);
    });
    const row = (swatch: boolean, name: string, meaning: string) => {
        const power = numberAt(summary, 'energy_W', name);
        return [h('span', {}, swatch && h('i', { class: `swatch ${name}` }), name), power === undefined ? '–' : figure(power),
        power === undefined || emitted <= 0 ? '–' : percent(power / emitted), h('span', { class: 'note' }, meaning)];
    };
    return h('div', {}, ...verdicts(summary), bar,
        table(['', 'power (W)', 'share', ''], [
            ...terms.map(([name, meaning]) => row(true, name, meaning)), row(false, 'remainder', 'what is then left: rounding'),
            row(false, 'emitted', 'by all sources: the sum of all above')]),
        absorbers(summary, emitted));
}
