// In: a summary. Out: its facts, warnings, objects, events, lost rays, and how it was run.
import { at, entriesAt, numberAt, textsAt, type Json, type PageData } from '../data';
import { details, h, table } from '../dom';
import { count, figure, percent, shown } from '../numbers';

export function box(summary: Json, key: string, kind: string, name: string): HTMLElement | undefined {
    const texts = textsAt(summary, key);
    if (texts.length === 0) return undefined;
    return h('aside', { class: `box ${kind}` }, h('b', {}, name), h('ul', {}, ...texts.map(text => h('li', {}, text))));
}

export function facts(summary: Json): HTMLElement {
    const seconds = numberAt(summary, 'seconds'), rate = numberAt(summary, 'segments_per_second');
    const tiles: [string, string][] = [
        [count(at(summary, 'rays')), 'rays'], [count(at(summary, 'segments')), 'segments'], [seconds === undefined ? '–' : `${figure(seconds, 3)} s`, 'time'],
        [rate === undefined ? '–' : `${figure(rate / 1e6, 3)} M/s`, 'segments per second'], [count(at(summary, 'threads')), 'threads'], [String(at(summary, 'seed') ?? '–'), 'seed']];
    return h('div', { class: 'facts' }, ...tiles.filter(([value]) => value !== '–').map(([value, name]) => h('span', {}, h('b', {}, value), ` ${name}`)));
}

export function events(summary: Json): HTMLElement | undefined {
    const entries = entriesAt(summary, 'events').filter((e): e is [string, number] => typeof e[1] === 'number' && e[1] > 0);
    const ends = entries.filter(([name]) => name !== 'recovered'), all = ends.reduce((sum, [, n]) => sum + n, 0);
    if (ends.length === 0) return undefined;
    const recovered = entries.find(([name]) => name === 'recovered');
    return h('div', {}, table(['segments ended by', 'count', 'share'], ends.sort((a, b) => b[1] - a[1]).map(([name, n]) => [name, count(n), percent(n / all)])),
        recovered && h('p', { class: 'note' }, `${count(recovered[1])} hits were in doubt and found again by the exact search.`));
}

export function lostRays(summary: Json): HTMLElement | undefined {
    const rows = entriesAt(summary, 'lost_rays').map(([, ray]) => [shown(at(ray, 'ray')), shown(at(ray, 'event')), shown(at(ray, 'at_mm')), shown(at(ray, 'power_W'))]);
    return rows.length ? table(['ray', 'event', 'at (mm)', 'power (W)'], rows) : undefined;
}

export function escaped(summary: Json): HTMLElement | undefined {
    const rows = entriesAt(summary, 'escaped_direction').slice(0, 40).map(([nm, direction]) => [nm, shown(direction)]);
    return rows.length ? table(['wavelength (nm)', 'mean direction'], rows) : undefined;
}

function meshText(model: Json | undefined): string {
    const triangles = numberAt(model, 'triangles');
    return triangles === undefined ? '–' : `${count(triangles)} triangles${at(model, 'closed') === false ? ', not closed' : ''}`;
}

export function objects(data: PageData): HTMLElement | undefined {
    const most = 200, models = at(data.summary, 'models');
    const entries = entriesAt(data.summary, 'objects'), meshes = entriesAt(models).length > 0;
    if (entries.length === 0) return undefined;
    const headings = ['object', 'medium', 'method', 'error of directions (rad)', ...(meshes ? ['mesh'] : [])];
    return h('div', {}, table(headings, entries.slice(0, most).map(([name, object]) => {
        const limit = at(object, 'error_bound_rad');
        return [name, shown(at(object, 'medium')), shown(at(object, 'method')), typeof limit === 'number' ? figure(limit, 3) : 'not stated', ...(meshes ? [meshText(at(models, name))] : [])];
    })), entries.length > most && h('p', { class: 'note' }, `The first ${most} of ${count(entries.length)}.`));
}

export function howItWasRun(summary: Json): HTMLElement | undefined {
    const options = at(summary, 'options'), hash = at(summary, 'experiment_sha256'), program = at(summary, 'program');
    if (options === undefined && hash === undefined) return undefined;
    return details('How it was run', program ? h('p', { class: 'note' }, `Traced by ${shown(program)}`) : null, hash ? h('p', { class: 'note' }, `SHA-256 of the experiment: ${shown(hash)}`) : null,
        options === undefined ? null : h('pre', {}, JSON.stringify(options, null, 2)));
}
