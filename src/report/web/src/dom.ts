// In: names of tags and texts. Out: elements. Texts from files go through here, as text nodes and never as markup.

type Child = Node | string | null | undefined | false;
type Handlers = Partial<{ [K in keyof HTMLElementEventMap]: (event: HTMLElementEventMap[K]) => void }>;

export interface Attributes {
    class?: string;
    id?: string;
    title?: string;
    on?: Handlers;
    attr?: Record<string, string>;
    style?: Record<string, string>;
}

export function h<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    if (attributes.class) element.className = attributes.class;
    if (attributes.id) element.id = attributes.id;
    if (attributes.title) element.title = attributes.title;
    for (const [name, value] of Object.entries(attributes.attr ?? {})) element.setAttribute(name, value);
    for (const [name, value] of Object.entries(attributes.style ?? {})) element.style.setProperty(name, value);
    for (const [name, handler] of Object.entries(attributes.on ?? {}))
        element.addEventListener(name, handler as EventListener);
    element.append(...children.filter((c): c is Node | string => c !== null && c !== undefined && c !== false));
    return element;
}

/// Rows of cells under headings; cells after the first are set as figures.
export function table(headings: string[], rows: Child[][]): HTMLTableElement {
    const cell = (tag: 'td' | 'th', content: Child, i: number) => h(tag, { class: i > 0 ? 'figure' : '' }, content);
    return h('table', {},
        h('thead', {}, h('tr', {}, ...headings.map((text, i) => cell('th', text, i)))),
        h('tbody', {}, ...rows.map(row => h('tr', {}, ...row.map((content, i) => cell('td', content, i))))));
}

export function details(summary: string, ...children: Child[]): HTMLDetailsElement {
    return h('details', {}, h('summary', {}, summary), ...children);
}
